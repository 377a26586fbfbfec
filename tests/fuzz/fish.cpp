// FISH functions and expressions: the result must be Lua that loads. It is not run.
#include "harness.hpp"

#include "../unit/script/fake_world.hpp"

#include "lang/fish/compiler.hpp"

#include <cstdlib>

using namespace kaya;

namespace {

Place first_of(const std::string& text) { return script::test::deck(text); }

template <class Action> void survive(Action action) {
    try {
        action();
    } catch (const Diagnostic& mistake) {
        // An internal error, or Lua that does not load, is a defect of the translator.
        if (mistake.fault == Fault::own || mistake.message.empty()) std::abort();
        if (render(mistake, true).empty()) std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > fuzz::largest) return 0;
    const std::string text = fuzz::text_of(data, size);
    static script::test::Stage stage;
    survive([&] { stage.scripts.define_fish(text, first_of(text)); });
    const std::string function = "def f\n" + text + "\nend\n";
    survive([&] { stage.scripts.define_fish(function, first_of(function)); });
    survive([&] {
        const auto expression = fish::read_expression(text, first_of(text));
        (void)fish::generate(expression, [](std::string_view name) {
            const bool known = name.size() % 3 == 0;
            return known ? fish::Meaning{fish::NameKind::built_in, 0, 9, true} : fish::Meaning{};
        });
    });
    static int count = 0;
    if (++count % 1000 == 0) stage.scripts.clear();
    return 0;
}
