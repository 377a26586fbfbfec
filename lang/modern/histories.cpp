// model history, block history, block contact history, history ...: curves over cycles.
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

#include <fmt/format.h>

namespace kaya::lang {

namespace {

/// Modern words, and the word of the classic `history` that records the same.
struct Quantity {
    const char* words;
    const char* classic;
    const char* help;
};

constexpr Quantity of_model[] = {
    {"unbalanced-maximum", "unbal", "largest unbalanced force"},
    {"time-total", "time", "time"},
};

/// Quantities of the model that have no classic word.
struct ModelField {
    const char* words;
    const char* field;
    const char* help;
};
constexpr ModelField model_fields[] = {
    {"cycles-total|cycles", "cycle", "cycles done so far"},
    {"ratio|ratio-average", "average_ratio", "unbalanced over average force"},
    {"ratio-local", "local_ratio", "largest ratio of unbalanced to acting force of one body"},
    {"ratio-maximum", "maximum_ratio", "largest unbalanced over average force"},
};

/// After the word energy.
constexpr Quantity of_energy[] = {
    {"kinetic", "ekinetic", "kinetic energy"},
    {"boundary-load", "eboundary", "work of loads, prescribed velocities and water on the blocks"},
    {"mass-damping", "edamped", "energy dissipated by damping and dashpots"},
    {"joint-friction", "efriction", "energy lost in slip and failure of joints"},
};

constexpr Quantity of_blocks[] = {
    {"displacement-x", "xdis", "displacement of the nearest gridpoint"},
    {"displacement-y", "ydis", "displacement of the nearest gridpoint"},
    {"displacement-z", "zdis", "displacement of the nearest gridpoint"},
    {"velocity-x", "xvel", "velocity of the nearest gridpoint"},
    {"velocity-y", "yvel", "velocity of the nearest gridpoint"},
    {"velocity-z", "zvel", "velocity of the nearest gridpoint"},
    {"acceleration-x", "xacc", "acceleration of the nearest gridpoint, of the last step"},
    {"acceleration-y", "yacc", "acceleration of the nearest gridpoint, of the last step"},
    {"acceleration-z", "zacc", "acceleration of the nearest gridpoint, of the last step"},
    {"stress-xx", "sxx", "stress of the nearest zone"},
    {"stress-yy", "syy", "stress of the nearest zone"},
    {"stress-zz", "szz", "stress of the nearest zone"},
    {"stress-xy", "sxy", "stress of the nearest zone"},
    {"stress-xz", "sxz", "stress of the nearest zone"},
    {"stress-yz", "syz", "stress of the nearest zone"},
    {"pore-pressure", "pp", "pore pressure of the nearest zone"},
};

constexpr Quantity of_contacts[] = {
    {"displacement-normal", "ndis", "normal displacement of the nearest sub-contact, closing negative"},
    {"displacement-shear", "sdis", "shear displacement of the nearest sub-contact"},
    {"displacement-shear-x", "xsdis", "shear displacement in x of the nearest sub-contact"},
    {"displacement-shear-y", "ysdis", "shear displacement in y of the nearest sub-contact"},
    {"displacement-shear-z", "zsdis", "shear displacement in z of the nearest sub-contact"},
    {"force-normal", "nfor", "normal force of the nearest sub-contact, compression positive"},
    {"force-shear", "sfor", "shear force of the nearest sub-contact"},
    {"stress-normal", "nstr", "normal stress of the nearest sub-contact, compression positive"},
    {"stress-shear", "sstr", "shear stress of the nearest sub-contact"},
};

/// The words that name a history before its quantity, or after its place.
void names(Leaf<HistoryAdd>& leaf) {
    for (const char* word : {"name", "label"})
        leaf.keyword({word},
                     Parts<HistoryAdd>().in(only_of(&HistoryAdd::items),
                                            Parts<HistoryItem>().then(text("name"), &HistoryItem::name)),
                     "name of the history in files; the number of the history if not given");
}

void record(Leaf<HistoryAdd>& leaf, const char* words, const HistoryItem::Quantity& quantity, const char* help) {
    const auto one_quantity = [](Reader& reader, HistoryItem& item) {
        if (item.text)
            throw Diagnostic("a history records one quantity", "write a second line for this one")
                .at(reader.previous().place);
    };
    const auto item =
        Parts<HistoryItem>().check(one_quantity).mark(&HistoryItem::text).set([quantity](HistoryItem& made) {
            made.what = quantity;
        });
    leaf.keyword(tree_words(words).front(), Parts<HistoryAdd>().in(only_of(&HistoryAdd::items), item), help);
}

void record(Leaf<HistoryAdd>& leaf, const Quantity& row) {
    record(leaf, row.words, recorded_quantity(row.classic), row.help);
    leaf.said(row.classic);
}

void needs_quantity(Leaf<HistoryAdd>& leaf, const char* example) {
    const std::string hint = fmt::format("write for example: {}", example);
    leaf.finish([hint](const Reader& reader, HistoryAdd& history) {
        if (history.items.empty() || !history.items.front().text)
            incomplete_line(reader, "the history has no quantity to record", hint);
    });
}

CommandSpec model_history() {
    Leaf<HistoryAdd> leaf("model history");
    leaf.means("history");
    leaf.help("records a quantity of the model from now on");
    names(leaf);
    leaf.no_effect("mechanical|dynamic", "of motion, the only process");
    for (const Quantity& row : of_model) record(leaf, row);
    for (const ModelField& row : model_fields) record(leaf, row.words, {ObjectKind::global, row.field, ""}, row.help);
    record(leaf, "timestep", {ObjectKind::global, "time_step", ""}, "time step");
    record(leaf, {"damping", "damp", "adaptive damping coefficient"});
    leaf.no_effect("energy", "before the word of an energy");
    for (const Quantity& row : of_energy) record(leaf, row);
    leaf.not_yet({"potential", "block-strain", "plastic-strain", "boundary-viscous", "joint-strain", "strain-total",
                  "released-total", "total-stored"},
                 "other energies: list energy shows those that are kept");
    leaf.not_yet({"thermal", "fluid", "creep"}, "heat, flow and creep");
    leaf.not_yet({"convergence"}, "the ratio of each gridpoint to its own target: see ratio-local");
    needs_quantity(leaf, "model history mechanical unbalanced-maximum");
    leaf.right("model history mechanical unbalanced-maximum", "hist unbal");
    leaf.right("model history dynamic time-total", "hist time").right("model history mech unb-max", "hist unbal");
    leaf.right("model history name 'ratio' mechanical ratio-local");
    leaf.right("model history energy kinetic", "hist ekinetic");
    leaf.wrong("model history", "the history has no quantity to record");
    leaf.wrong("model history name 'a'", "the history has no quantity to record");
    leaf.wrong("model history mechanical unbalanced-maximun", "'unbalanced-maximun' is not a keyword of model history");
    return leaf;
}

void location(Leaf<HistoryAdd>& leaf) {
    leaf.keyword({"position"},
                 Parts<HistoryAdd>().in(only_of(&HistoryAdd::items),
                                        Parts<HistoryItem>().then(vector("x y z").unit("length"), &HistoryItem::place)),
                 "the nearest object is recorded; the origin if not given");
    leaf.said(" "); // hist xdis 0 0 1
}

CommandSpec block_history() {
    Leaf<HistoryAdd> leaf("block history");
    leaf.means("history");
    leaf.help("records a quantity of a gridpoint or zone from now on");
    names(leaf);
    leaf.not_yet({"displacement", "velocity", "acceleration"}, "magnitudes: give -x, -y or -z");
    for (const Quantity& row : of_blocks) record(leaf, row);
    location(leaf);
    leaf.not_yet({"gridpointid", "zoneid", "index", "log", "gravity", "component", "source", "method"},
                 "other places and forms of a quantity: see position");
    leaf.not_yet({"property", "extra", "temperature", "strain-increment", "strain-rate", "condition"},
                 "quantities that a FISH function can record: fish history");
    needs_quantity(leaf, "block history displacement-z position 0 0 1");
    leaf.right("block history displacement-z position 0 0 1", "hist zdis 0 0 1");
    leaf.right("block hist vel-x position (0,0,1)", "hist xvel 0 0 1");
    leaf.right("block history name 'crown' velocity-z position 0 0 1");
    leaf.right("block history stress-zz position 0 0 2", "hist szz 0 0 2");
    leaf.wrong("block history", "the history has no quantity to record");
    leaf.wrong("block history displacment-x position 0 0 1", "'displacment-x' is not a keyword of block history");
    leaf.wrong("block history displacement-x position 0 0", "a number is missing after '0'");
    leaf.wrong("block history displacement-x velocity-x", "a history records one quantity");
    return leaf;
}

CommandSpec contact_history() {
    Leaf<HistoryAdd> leaf("block contact history");
    leaf.means("history");
    leaf.help("records a quantity of a sub-contact from now on");
    names(leaf);
    for (const Quantity& row : of_contacts) record(leaf, row);
    location(leaf);
    leaf.not_yet({"contact-id", "subcontact-id", "dip", "dip-direction"}, "other places: see position");
    leaf.not_yet({"area-sum", "force-normal-sum", "force-shear-sum", "area", "velocity-shear"},
                 "quantities that a FISH function can record: fish history");
    needs_quantity(leaf, "block contact history force-normal position 0 0 1");
    leaf.right("block contact history force-normal position 0 0 1", "hist nfor 0 0 1");
    leaf.right("block contact history stress-shear position 0 0 1", "hist sstr 0 0 1");
    leaf.wrong("block contact history position 0 0 1", "the history has no quantity to record");
    return leaf;
}

CommandSpec history_interval() {
    Leaf<HistoryAdd> leaf("history interval");
    leaf.means("history ncyc");
    leaf.help("cycles from one record to the next, for all histories");
    leaf.argument(integer("n").at_least(1), &HistoryAdd::interval);
    leaf.right("history interval 5", "hist ncyc 5");
    leaf.wrong("history interval 0", "interval must be at least 1, not 0");
    return leaf;
}

CommandSpec history_delete() {
    Leaf<HistoryDelete> leaf("history delete", "history delete");
    leaf.values_of_meaning();
    leaf.right("history delete", "history delete");
    return leaf;
}

CommandSpec history_export() {
    Leaf<HistoryWrite> leaf("history export");
    leaf.help("writes histories as a table with a line of names on top");
    const auto name = text("name").optional();
    const ArgumentSpec versus = text("name").spec;
    leaf.keyword({"vs"},
                 Parts<HistoryWrite>().argument(versus).by(
                     [versus](Reader& reader, HistoryWrite& write) {
                         const Word* word = reader.peek();
                         const bool cycle = word != nullptr && word->kind == WordKind::word && word->folded == "step";
                         std::string first = reader.text(versus);
                         if (!cycle) write.versus_name = std::move(first);
                     },
                     [](Parts<HistoryWrite>::Form form, const HistoryWrite& wanted) {
                         form.words.push_back({wanted.versus_name, true});
                         form.after.versus_name = wanted.versus_name;
                         return Parts<HistoryWrite>::Forms{std::move(form)};
                     }),
                 "the history that makes the first column; `step`: the cycle, as without the word");
    leaf.keyword({"file", "filename"}, text("file"), &HistoryWrite::file,
                 "name of the file; that of the deck with .csv if not given");
    leaf.no_effect("truncate", "the file is replaced, as always");
    leaf.not_yet({"append", "reverse", "begin", "end", "skip", "table"}, "parts of histories in files");
    leaf.values(Parts<HistoryWrite>().next(name, &HistoryWrite::names), [](Reader& reader, HistoryWrite&) {
        const WordKind kind = reader.peek()->kind;
        return kind == WordKind::text || kind == WordKind::number || reader.peek()->late();
    });
    leaf.right("history export '1' '2' vs '3' file 'curves.csv'").right("history export 1 file 'curves'");
    leaf.right("history export 'crown' vs step file 'crown.csv'");
    leaf.wrong("history export '1' vs", "a word is missing after 'vs'");
    leaf.wrong("history export '1' fiel 'a'", "'fiel' is not a keyword of history export");
    return leaf;
}

} // namespace

std::vector<CommandSpec> model_history_commands() { return {model_history()}; }
std::vector<CommandSpec> block_history_commands() { return {block_history(), contact_history()}; }
std::vector<CommandSpec> history_commands() {
    Leaf<List> list("history list");
    list.means("list hist").help("histories: number, name, least and greatest value");
    list.start([](const Statement&, List& command) { command.what = List::What::histories; });
    list.right("history list", "list histories");
    return {history_interval(),
            history_delete(),
            history_export(),
            list,
            unsupported_line("history purge", "emptying histories: history delete, and define them again"),
            unsupported_line("history rename", "other names of histories"),
            unsupported_line("history results", "files of results")};
}

} // namespace kaya::lang
