#include "system/loaded_library.hpp"

#include "system/crash_report.hpp"

#include <dlfcn.h>

namespace kaya {

std::shared_ptr<void> load_library(const std::filesystem::path& name, const Called* who, std::string& fault) {
    // Local symbols keep models apart.
    void* const handle = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        fault = ::dlerror();
        return nullptr;
    }
    return {handle, [who](void* library) {
                const AtWork unloading(who, "unloading");
                ::dlclose(library);
            }};
}

void* symbol_of(void* library, const char* symbol) { return ::dlsym(library, symbol); }

void keep_loaded(const std::filesystem::path& name) { ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE); }

std::filesystem::path file_of_code(const void* place) {
    Dl_info info{};
    return ::dladdr(place, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

} // namespace kaya
