// Bytes as changes of the state of a model, and of its save: from the image to the model to its check, three cycles and a mesh.
#include "harness.hpp"

#include "../unit/steps/hostile_model.hpp"

#include "commands/session/save_session.hpp"
#include "io/save_trailer.hpp"
#include "system/whole_file.hpp"

#include <cstdlib>
#include <cstring>

using namespace kaya;

namespace {

/// The input as numbers; zeros after its end.
class Choices {
public:
    Choices(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
    bool any() const { return left_ > 0; }
    std::uint64_t number(std::size_t bytes) {
        std::uint64_t value = 0;
        const std::size_t count = std::min(bytes, left_);
        if (count > 0) std::memcpy(&value, data_, count);
        data_ += count;
        left_ -= count;
        return value;
    }

private:
    const std::uint8_t* data_;
    std::size_t left_;
};

struct Good {
    test::Scene scene;
    Model model;
    std::size_t places;

    Good() {
        scene.run(test::hostile_deck);
        model = scene.session().engine.model;
        test::Mutation counting;
        Model copy = model;
        visit_state(counting, copy);
        places = counting.count();
    }
};

/// False if the lines were refused.
bool survive(test::Scene& scene, const char* lines) {
    try {
        scene.run(lines);
        return true;
    } catch (const Diagnostic& refusal) {
        if (refusal.fault == Fault::own || render(refusal).empty()) std::abort();
        return false;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t largest = 256;
    if (size > largest) return 0;
    static Good good;
    Choices choices(data, size);
    Model model = good.model;
    const std::size_t changes = choices.number(1) % 4;
    for (std::size_t k = 0; k < changes; ++k) {
        test::Mutation mutation(choices.number(2) % good.places, [&] { return choices.number(8); });
        visit_state(mutation, model);
    }
    std::string image = save_image(model, session_extras(good.scene.session()));
    image.resize(without_trailer(image, "fuzz").size());
    for (int k = 0; choices.any() && k < 16; ++k)
        image[choices.number(4) % image.size()] = static_cast<char>(choices.number(1));
    write_whole_file("fuzz.kaya.h5", with_trailer(std::move(image)));

    test::Scene scene;
    if (!survive(scene, "restore fuzz.kaya.h5")) return 0;
    for (const char* lines : {"cycle 3", "gen edge 0.6", "list max"}) survive(scene, lines);
    return 0;
}
