// block ...: selecting blocks, holding and moving them.
#include "lang/modern/components.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>

namespace kaya::lang {

namespace {

CommandSpec hide_blocks() {
    Leaf<Hide> leaf("block hide");
    leaf.means("hide");
    leaf.help("hides blocks; new blocks are visible");
    leaf.ranged(&Hide::range);
    leaf.action(
        {"on", "true", "yes"}, [](Hide&) {}, "hides, the default");
    leaf.right("block hide", "hide").right("block hide on", "hide");
    leaf.right("block hide range group 'wall'", "hide range group wall");
    leaf.wrong("block hide onn", "'onn' is not a keyword of block hide")
        .wrong("block hide range", "the range is empty");
    return leaf;
}

CommandSpec show_blocks() {
    Leaf<Seek> leaf("block hide off|false|no");
    leaf.means("seek");
    leaf.help("makes hidden blocks visible again");
    leaf.ranged(&Seek::range);
    leaf.right("block hide off", "seek").right("block hide off range region 1", "seek range region 1");
    leaf.wrong("block hide off now", "'now' is not a keyword of block hide off");
    return leaf;
}

CommandSpec show_word() {
    Leaf<Seek> leaf("block show");
    leaf.means("seek");
    leaf.help("makes hidden blocks visible again");
    leaf.ranged(&Seek::range);
    leaf.right("block show range region 1", "seek range region 1");
    leaf.wrong("block show all", "'all' is not a keyword of block show");
    return leaf;
}

CommandSpec remove_blocks() {
    Leaf<Delete> leaf("block delete|remove", "delete");
    leaf.ranged(&Delete::range);
    leaf.not_yet({"wall"}, "blocks that are walls");
    leaf.right("block delete range group 'ball'", "delete range group ball").right("block delete", "delete");
    leaf.wrong("block delete rnage id 1", "'rnage' is not a keyword of block delete");
    return leaf;
}

CommandSpec excavate() {
    Leaf<Excavate> leaf("block excavate", "excavate");
    leaf.not_yet({"face-group", "block-group", "boundary-contact-group", "internal-contact-group"},
                 "groups for what an excavation leaves");
    leaf.ranged(&Excavate::range);
    leaf.right("block excavate range group 'tunnel'", "excavate range group tunnel");
    leaf.wrong("block excavate rage region 3", "'rage' is not a keyword of block excavate");
    return leaf;
}

CommandSpec fill_blocks() {
    Leaf<Fill> leaf("block fill", "fill");
    leaf.not_yet({"face-group", "block-group", "boundary-contact-group", "internal-contact-group"},
                 "groups for what is filled");
    leaf.ranged(&Fill::range);
    leaf.right("block fill", "fill");
    leaf.wrong("block fill tunnel", "'tunnel' is not a keyword of block fill");
    return leaf;
}

CommandSpec copy_blocks() {
    Leaf<Copy> leaf("block copy", "copy");
    leaf.word("translate", "offset");
    const auto id = integer("i").at_least(1);
    const Through only_element{[](RangePhrase& range, std::int64_t number) {
                                   RangeElement element;
                                   element.kind = RangeElement::Kind::id;
                                   element.low = element.high = static_cast<double>(number);
                                   range.elements = {element};
                               },
                               [](const RangePhrase& range) {
                                   return range.elements.size() == 1
                                              ? std::optional(static_cast<std::int64_t>(range.elements.front().low))
                                              : std::nullopt;
                               }};
    const auto number =
        Parts<RangePhrase>().mark(&RangePhrase::place).then(id, only_element).check([](Reader&, RangePhrase& range) {
            range.elements.front().place = range.place;
        });
    leaf.keyword({"id"}, Parts<Copy>().in(member(&Copy::range), number), "number of the block");
    leaf.not_yet({"near", "scale", "fix", "hide"}, "other copies: give id and translate");
    leaf.finish([](const Reader& reader, Copy& command) {
        if (!command.offset || !command.range.place)
            incomplete_line(reader, "block copy needs id and translate", "write: block copy id 1 translate 0 0 2");
    });
    leaf.right("block copy id 1 translate 0 20 0", "copy offset 0 20 0 range id 1");
    leaf.wrong("block copy id 1", "block copy needs id and translate");
    return leaf;
}

CommandSpec block_join() {
    Leaf<Join> leaf("block join", "join");
    leaf.word("on", "on").word("off", "off").ranged(&Join::range);
    leaf.right("block join on", "join on").right("block join range group 'wall'", "join range group wall");
    leaf.wrong("block join oof", "'oof' is not a keyword of block join");
    return leaf;
}

CommandSpec fix_blocks() {
    Leaf<Fix> leaf("block fix", "fix");
    leaf.word("velocity", "velocity");
    for (const auto& component : velocity_components) leaf.word(component.words, component.classic);
    leaf.word("rotation", "rotation").word("rotation-x", "rxvel").word("rotation-y", "ryvel");
    leaf.word("rotation-z", "rzvel").ranged(&Fix::range);
    leaf.right("block fix range region 1", "fix range region 1").right("block fix", "fix");
    leaf.right("block fix velocity-x rotation range id 2", "fix xvel rotation range id 2");
    leaf.wrong("block fix reigon 1", "'reigon' is not a keyword of block fix");
    leaf.wrong("block fix range position-z low", "expected a number, found 'low'");
    return leaf;
}

CommandSpec free_blocks() {
    Leaf<Free> leaf("block free", "free");
    const auto with_value = [&](const char* words, const char* classic) {
        KeywordSpec keyword = classic_keyword(classic_command("free"), classic);
        const ArgumentSpec number = real("v").optional().spec;
        const auto read = [keyword, number](Reader& reader, Free& command) {
            keyword.read(reader, &command);
            while (reader.at_number()) (void)reader.real(number); // 3DEC ignores them as well
        };
        leaf.keyword(tree_words(words).front(), Parts<Free>().argument(number).by(read, {}), keyword.help);
        leaf.prints(keyword.write);
    };
    with_value("velocity", "velocity");
    for (const auto& component : velocity_components) with_value(component.words, component.classic);
    with_value("rotation", "rotation");
    with_value("rotation-x", "rxvel");
    with_value("rotation-y", "ryvel");
    with_value("rotation-z", "rzvel");
    leaf.ranged(&Free::range);
    leaf.right("block free range id 3 5", "free range id 3 5");
    leaf.right("block free velocity-z 0 rotation-y range id 3", "free zvel ryvel range id 3");
    leaf.wrong("block free range id 1.5", "id takes a whole number, not 1.5");
    return leaf;
}

CommandSpec block_apply() {
    Leaf<Apply> leaf("block apply", "apply");
    vector_words(
        leaf, "velocity", velocity_components, "velocity",
        [](Apply & command, std::size_t k) -> auto& { return command.velocity[k]; },
        "prescribed velocity of the blocks, all components");
    multiplier_words(leaf);
    leaf.ranged(&Apply::range);
    leaf.finish([](const Reader& reader, Apply& command) {
        if (std::ranges::none_of(command.velocity, [](const auto& v) { return v.has_value(); }))
            incomplete_line(reader, "block apply has no velocity", "expected: velocity, velocity-x, -y or -z");
    });
    leaf.right("block apply velocity-z 0.8 range region 2", "apply zvel 0.8 range region 2");
    leaf.right("block apply velocity-x 1 table '1' range id 2", "apply xvel 1 hist table 1 range id 2");
    leaf.right("block apply velocity 0 0 -1 range id 2", "apply xvel 0 yvel 0 zvel -1 range id 2");
    leaf.right("block apply velocity-x 1 fish wave range id 2", "apply xvel 1 hist @wave range id 2");
    leaf.wrong("block apply", "block apply has no velocity");
    leaf.wrong("block apply velocity-x", "a number is missing after 'velocity-x'");
    leaf.wrong("block apply velocty-x 1", "'velocty-x' is not a keyword of block apply");
    return leaf;
}

CommandSpec block_initialize() {
    Leaf<Initialize> leaf("block initialize", "initialize");
    vector_words(
        leaf, "velocity", velocity_components, "velocity",
        [](Initialize & command, std::size_t k) -> auto& { return command.velocity[k]; }, "velocity");
    vector_words(
        leaf, "rvelocity", {{{"rvelocity-x", "rxvel"}, {"rvelocity-y", "ryvel"}, {"rvelocity-z", "rzvel"}}},
        "angle in radians/time", [](Initialize & command, std::size_t k) -> auto& { return command.velocity[3 + k]; },
        "rotation of rigid blocks");
    leaf.not_yet({"extra"}, "extra variables of blocks: FISH has block.extra");
    leaf.not_yet({"add", "multiply", "gradient", "vary", "local"}, "changes of the values that are there");
    leaf.ranged(&Initialize::range);
    leaf.finish([](const Reader& reader, Initialize& command) {
        if (std::ranges::none_of(command.velocity, [](const auto& v) { return v.has_value(); }))
            incomplete_line(reader, "block initialize does not say what to set", "expected: velocity or rvelocity");
    });
    leaf.right("block initialize velocity 0 0 -2 range group 'ball'",
               "initialize xvel 0 yvel 0 zvel -2 range group ball");
    leaf.right("block initialize rvelocity-z 0.5 range id 2", "ini rzvel 0.5 range id 2");
    leaf.wrong("block initialize", "block initialize does not say what to set");
    leaf.wrong("block initialize velocity 0 0", "a number is missing after '0'");
    return leaf;
}

CommandSpec block_group() {
    auto leaf = group_leaf("block group", "group block");
    leaf.right("block group 'left wall' range position-x -1 0.9", "group block 'left wall' range x -1 0.9");
    leaf.right("block group 'all'", "group block all");
    leaf.right("block group 'thin' slot '1' range edge-length 0 0.1",
               "group block thin slot 1 range edge-length 0 0.1");
    leaf.right("block group 'thin' slot '1' remove", "group block thin slot 1 remove");
    leaf.right("block group '1=thin'", "group block '1=thin'");
    leaf.wrong("block group 'a' solt '1'", "'solt' is not a keyword of block group");
    leaf.wrong("block group", "a word is missing after 'group'");
    leaf.wrong("block group 'a' rnage id 1", "'rnage' is not a keyword of block group");
    return leaf;
}

CommandSpec block_density() {
    Leaf<BlockDensity> leaf("block property density");
    leaf.help("density of the blocks; those without a range keep their material, others get a separate one");
    leaf.argument(real("density").unit("mass/length^3").above(0), &BlockDensity::density);
    leaf.ranged(&BlockDensity::range);
    leaf.right("block property density 2000").right("block prop dens 2500 range group 'wall'");
    leaf.wrong("block property", "a word is missing after 'property'");
    leaf.wrong("block property density", "a number is missing after 'density'");
    leaf.wrong("block property density 0", "density must be greater than 0, not 0");
    leaf.wrong("block property densty 1", "'densty' is not a kind of block property");
    return leaf;
}

} // namespace

/// Prescribed velocities that are taken away: `block apply-remove`, `block gridpoint apply-remove`.
CommandSpec apply_remove(std::string_view words, std::string_view example, std::string_view classic) {
    Leaf<Boundary> leaf(words, "boundary");
    leaf.help("removes prescribed velocities, and nothing else");
    leaf.action(
        {"velocity"}, [](Boundary& b) { b.free[0] = b.free[1] = b.free[2] = true; }, "in no direction");
    for (const auto& [component, release] :
         {std::pair("velocity-x", "xfree"), std::pair("velocity-y", "yfree"), std::pair("velocity-z", "zfree")})
        leaf.word(component, release);
    leaf.not_yet({"force", "force-x", "force-y", "force-z"},
                 "forces that are taken away: apply the opposite force, forces of a place are added");
    leaf.not_yet({"velocity-normal", "quiet", "viscous", "reaction", "source", "temperature"},
                 "conditions that are taken away");
    leaf.ranged(&Boundary::range);
    leaf.finish([](const Reader& reader, Boundary& b) {
        if (!b.free[0] && !b.free[1] && !b.free[2])
            incomplete_line(reader, "the line does not say what to remove", "expected: velocity, velocity-x, -y or -z");
    });
    leaf.right(example, classic);
    leaf.wrong(words, "the line does not say what to remove");
    return leaf;
}

std::vector<CommandSpec> block_commands() {
    return {
        hide_blocks(),
        show_blocks(),
        show_word(),
        remove_blocks(),
        excavate(),
        fill_blocks(),
        copy_blocks(),
        block_join(),
        fix_blocks(),
        free_blocks(),
        block_apply(),
        apply_remove("block apply-remove", "block apply-remove velocity-x range id 2", "bound xfree range id 2"),
        block_initialize(),
        block_group(),
        block_density(),
        ignored_line("block generate", "no block is made without a further word", "it makes no block",
                     "block generate"),
        ignored_line("block update", "cycles between two updates", "kaya updates contacts when they need it",
                     "block update subcontact 100"),
        ignored_line("block cells", "the grid of the search for contacts", "kaya needs none", "block cells size 10"),
        ignored_line("block joint-plane", "data of pictures", "kaya draws joints from the contacts",
                     "block joint-plane on"),
    };
}

} // namespace kaya::lang
