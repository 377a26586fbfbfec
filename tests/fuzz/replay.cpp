// Runs a harness on every file of some folders: regression tests of former findings.
#include "harness.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

int main(int count, char** arguments) {
    namespace fs = std::filesystem;
    std::vector<std::string> inputs;
    for (int i = 1; i < count; ++i) {
        if (!fs::is_directory(arguments[i])) continue;
        for (const auto& entry : fs::directory_iterator(arguments[i])) {
            std::ifstream stream(entry.path(), std::ios::binary);
            inputs.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
        }
    }
    if (inputs.empty()) {
        std::fputs("there is no input to replay\n", stderr);
        return 2;
    }
    LLVMFuzzerInitialize(&count, &arguments);
    for (const auto& input : inputs)
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    std::printf("%zu inputs\n", inputs.size());
    return 0;
}
