// Histories: quantities recorded while the model cycles.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

namespace {

struct Recorded {
    std::vector<Spelling> words;
    ObjectKind kind;
    const char* field;
    const char* rate; ///< the name under which its rate is recorded; "": the field itself
    const char* help;
};

/// Words of `hist` and the field that each of them records. Fields of an object take a place, and the nearest object is recorded.
const std::vector<Recorded>& recorded() {
    using enum ObjectKind;
    static const std::vector<Recorded> words = {
        // A row per word.
        // clang-format off
        {{"unbal", "unbalanced"}, global, "unbalanced_force", "", "largest unbalanced force"},
        {{"time"}, global, "time", "", "time"},
        {{"damp", "damping"}, global, "global_viscosity", "", "adaptive damping coefficient"},
        {{"ekinetic"}, global, "kinetic_energy", "", "kinetic energy"},
        {{"egravity"}, global, "gravity_work", "", "work of gravity on the blocks"},
        {{"eboundary"}, global, "boundary_work", "", "work of loads, prescribed velocities and water on the blocks"},
        {{"edamped"}, global, "damped_energy", "", "energy dissipated by damping and dashpots"},
        {{"ejoint"}, global, "joint_work", "", "work on joints: stored or lost"},
        {{"efriction"}, global, "frictional_energy", "", "of it, lost in slip and failure"},
        {{"etouch"}, global, "touch_energy", "", "of it, lost in contact updates"},
        {{"ezone"}, global, "zone_work", "", "work on zones"},
        {{"estructure", "ecable"}, global, "structure_work", "", "work on cables, beams and liners: stored or lost"},
        {{"eerror"}, global, "energy_error", "", "residual of the energy balance"},
        {{"xdis", "xdisplacement"}, gridpoint, "x_displacement", "", "displacement in x of the nearest gridpoint"},
        {{"ydis", "ydisplacement"}, gridpoint, "y_displacement", "", "displacement in y of the nearest gridpoint"},
        {{"zdis", "zdisplacement"}, gridpoint, "z_displacement", "", "displacement in z of the nearest gridpoint"},
        {{"xvel", "xvelocity"}, gridpoint, "x_velocity", "", "velocity in x of the nearest gridpoint"},
        {{"yvel", "yvelocity"}, gridpoint, "y_velocity", "", "velocity in y of the nearest gridpoint"},
        {{"zvel", "zvelocity"}, gridpoint, "z_velocity", "", "velocity in z of the nearest gridpoint"},
        {{"xacc", "xacceleration"}, gridpoint, "x_velocity", "x_acceleration", "acceleration in x of the nearest gridpoint, of the last step"},
        {{"yacc", "yacceleration"}, gridpoint, "y_velocity", "y_acceleration", "acceleration in y of the nearest gridpoint, of the last step"},
        {{"zacc", "zacceleration"}, gridpoint, "z_velocity", "z_acceleration", "acceleration in z of the nearest gridpoint, of the last step"},
        {{"sxx"}, zone, "xx_stress", "", "stress of the nearest zone"},
        {{"syy"}, zone, "yy_stress", "", "stress of the nearest zone"},
        {{"szz"}, zone, "zz_stress", "", "stress of the nearest zone"},
        {{"sxy"}, zone, "xy_stress", "", "stress of the nearest zone"},
        {{"sxz"}, zone, "xz_stress", "", "stress of the nearest zone"},
        {{"syz"}, zone, "yz_stress", "", "stress of the nearest zone"},
        {{"sig1"}, zone, "principal_stress_1", "", "most compressive principal stress of the nearest zone"},
        {{"sig2"}, zone, "principal_stress_2", "", "middle principal stress of the nearest zone"},
        {{"sig3"}, zone, "principal_stress_3", "", "least compressive principal stress of the nearest zone"},
        {{"pp"}, zone, "pore_pressure", "", "pore pressure of the nearest zone: the mean of its gridpoints"},
        {{"ndis", "ndisplacement"}, sub_contact, "normal_displacement", "", "normal displacement of the nearest sub-contact, closing negative"},
        {{"sdis", "sdisplacement"}, sub_contact, "shear_displacement", "", "shear displacement of the nearest sub-contact"},
        {{"xsdis", "xsdisplacement"}, sub_contact, "x_shear_displacement", "", "shear displacement in x of the nearest sub-contact"},
        {{"ysdis", "ysdisplacement"}, sub_contact, "y_shear_displacement", "", "shear displacement in y of the nearest sub-contact"},
        {{"zsdis", "zsdisplacement"}, sub_contact, "z_shear_displacement", "", "shear displacement in z of the nearest sub-contact"},
        {{"nstr", "nstress"}, sub_contact, "normal_stress", "", "normal stress of the nearest sub-contact, compression positive"},
        {{"sstr", "sstress"}, sub_contact, "shear_stress", "", "shear stress of the nearest sub-contact"},
        {{"cforce"}, cable_node, "cable_force", "", "tension of the cable at the nearest cable node"},
        {{"cslip"}, cable_node, "slip", "", "slip of the cable there, past the rock towards its last end"},
        {{"cbond"}, cable_node, "grout_force", "", "force of the grout there, per length of cable"},
        {{"xnode"}, structure_node, "x_displacement", "", "displacement in x of the nearest node of beams and liners"},
        {{"ynode"}, structure_node, "y_displacement", "", "displacement in y of that node"},
        {{"znode"}, structure_node, "z_displacement", "", "displacement in z of that node"},
        {{"ltension"}, structure_node, "link_tension", "", "tension of the link of that node to the rock, per area or length"},
        {{"lshear"}, structure_node, "link_shear", "", "shear of that link"},
        {{"baxial"}, beam_element, "axial_force", "", "axial force of the nearest element of beams, tension positive"},
        {{"bmoment"}, beam_element, "moment", "", "largest bending moment of that element"},
        {{"lthrust"}, liner_element, "membrane_2", "", "smaller principal membrane force of the nearest element of liners, tension positive"},
        {{"lstress"}, liner_element, "greatest_stress", "", "greatest principal stress at the surfaces of that element, tension positive"},
        {{"nfor", "nforce"}, sub_contact, "normal_force", "", "normal force of the nearest sub-contact, compression positive"},
        {{"sfor", "sforce"}, sub_contact, "shear_force", "", "shear force of the nearest sub-contact"},
        {{"xsfor", "xsforce"}, sub_contact, "x_shear_force", "", "shear force in x of the nearest sub-contact"},
        {{"ysfor", "ysforce"}, sub_contact, "y_shear_force", "", "shear force in y of the nearest sub-contact"},
        {{"zsfor", "zsforce"}, sub_contact, "z_shear_force", "", "shear force in z of the nearest sub-contact"},
        // clang-format on
    };
    return words;
}

Parts<HistoryItem> recorded_as(const HistoryItem::Quantity& quantity) {
    return Parts<HistoryItem>().mark(&HistoryItem::text).set([quantity](HistoryItem& item) { item.what = quantity; });
}

CommandSpec history_add() {
    Entry<HistoryAdd> entry({"history"});
    entry.help("records quantities from now on; a line may have several");
    const auto place = vector("x y z").unit("length");
    for (const auto& item : recorded()) {
        const bool has_place = item.kind != ObjectKind::global;
        const HistoryItem::Quantity quantity{item.kind, item.field, item.rate};
        auto parts = recorded_as(quantity);
        if (has_place) parts.then(place, &HistoryItem::place);
        entry.keyword(item.words, Parts<HistoryAdd>().in(next_of(&HistoryAdd::items), parts), item.help);
    }
    const auto own = Parts<HistoryItem>()
                         .mark(&HistoryItem::text)
                         .in(as<HistoryItem::Own>(&HistoryItem::what),
                             Parts<HistoryItem::Own>().then(text("name"), &HistoryItem::Own::name))
                         .then(place, &HistoryItem::place);
    entry.keyword(
        {"jprop", "jproperty"}, Parts<HistoryAdd>().in(next_of(&HistoryAdd::items), own),
        "value of the nearest sub-contact by that name: history of its joint model, a field, a property that its object holds");
    entry.keyword({"ncyc", "ncycle", Spelling{"nstep", 1}}, integer("n").at_least(1), &HistoryAdd::interval,
                  "cycles from one record to the next, for all histories");
    entry.place(&HistoryAdd::place);
    const auto number = integer("n").at_least(1);
    entry.otherwise({text("@name").optional().spec}, [number](Reader& reader, HistoryAdd& history) {
        if (reader.peek()->kind == WordKind::number && reader.peek() == &reader.statement().words[1]) {
            history.number = reader.integer(number.spec);
            return true;
        }
        if (reader.peek()->kind != WordKind::symbol) return false;
        const std::string name = reader.symbol(text("@name").spec);
        history.items.push_back({HistoryItem::Script{name}, Vec3::Zero(), reader.previous().place});
        return true;
    });
    entry.prints(Parts<HistoryAdd>().by({}, [](Parts<HistoryAdd>::Form form, const HistoryAdd& wanted) {
        Parts<HistoryAdd>::Forms forms;
        auto& items = form.after.items;
        if (wanted.number && !form.after.number && items.empty()) {
            forms.push_back(form);
            print_value(forms.back().words, *wanted.number);
            forms.back().after.number = wanted.number;
        }
        if (items.size() >= wanted.items.size()) return forms;
        const HistoryItem& next = wanted.items[items.size()];
        if (const auto* script = std::get_if<HistoryItem::Script>(&next.what)) {
            form.words.push_back({"@" + script->symbol});
            items.push_back(next);
            forms.push_back(std::move(form));
        }
        return forms;
    }));
    entry.finish([](const Reader& reader, HistoryAdd& history) {
        if (history.items.empty() && !history.interval)
            incomplete_line(reader, "history has no quantity to record", "write for example: hist unbal");
    });
    entry.right("hist n 10 unbal")
        .right("hist unbal ncyc 5")
        .right("hist @sstav @nstav")
        .right("hist sdis -1 -1 0 ndis -1 -1 0");
    entry.right("hist ekinetic eerror").right("hist xacc 0 0 10 sig1 0 0 0").right("hist 1 unbal");
    entry.right("hist zdisp 0 0 0.1").right("his xvel (0,0,1)").right("hist szz 0 0 0.1").right("hist ncyc 100");
    entry.right("hist jprop 'slip' 0 0 0");
    entry.wrong("hist jprop slip 0 0", "a number is missing after '0'");
    entry.wrong("hist", "history has no quantity to record");
    entry.wrong("hist xdis 0 0", "a number is missing after '0'");
    entry.wrong("hist xids 0 0 0", "'xids' is not a keyword of history");
    entry.wrong("hist xacc 0 0", "a number is missing after '0'");
    entry.wrong("hist ncyc 0", "ncyc must be at least 1, not 0");
    entry.wrong("hist unbal 5", "expected a keyword of history, found '5'");
    return entry;
}

CommandSpec history_write() {
    Entry<HistoryWrite> entry({"history"}, {"write"});
    entry.help("writes histories as a table with a line of names on top");
    entry.place(&HistoryWrite::place);
    entry.keyword({"vs", "v"}, integer("m").at_least(1), &HistoryWrite::versus,
                  "number of the history that makes the first column, in place of the cycle");
    entry.keyword({"file"}, text("file"), &HistoryWrite::file, "name of the file; the word file may be left out");
    const auto number = integer("n").at_least(1).optional();
    const auto file = text("file").optional();
    entry.otherwise({number.spec, file.spec}, [=](Reader& reader, HistoryWrite& write) {
        if (reader.peek()->kind == WordKind::number) {
            write.numbers.push_back(reader.integer(number.spec));
            return true;
        }
        if (!write.file.empty()) return false;
        write.file = reader.text(file.spec);
        return true;
    });
    entry.prints(Parts<HistoryWrite>().next(number, &HistoryWrite::numbers));
    entry.right("hist write")
        .right("hist write 2 3 4 vs 5 curves.csv")
        .right("hist write 'all curves.csv'")
        .right("hist write 1 vs 2 file curves.csv");
    entry.wrong("hist write 0", "write must be at least 1, not 0");
    entry.wrong("hist write 1 vs", "a number is missing after 'vs'");
    entry.wrong("hist write 1 a.csv b.csv", "'b.csv' is not a keyword of history write");
    return entry;
}

CommandSpec history_label() {
    return Entry<HistoryLabel>({"history"}, {"label"})
        .help("names a history; written tables have the name")
        .place(&HistoryLabel::place)
        .argument(integer("n").at_least(1).help("number of the history, counted from 1"), &HistoryLabel::number)
        .argument(text("text").help("the name"), &HistoryLabel::text)
        .right("hist label 2 'Shear Stress'")
        .wrong("hist label", "a number is missing after 'label'")
        .wrong("hist label 2", "a word is missing after '2'")
        .wrong("hist label 'Shear Stress' 2", "expected a whole number, found the text 'Shear Stress'")
        .wrong("hist label 2 'Shear Stress", "the quote is not closed on this line");
}

CommandSpec history_delete() {
    Entry<HistoryDelete> entry({"history"}, {"delete"});
    entry.help("deletes histories, all if no number is given; the others keep their numbers");
    entry.place(&HistoryDelete::place);
    entry.values(Parts<HistoryDelete>().next(integer("n").at_least(1), &HistoryDelete::numbers),
                 [](Reader& reader, HistoryDelete&) {
                     return reader.peek()->kind == WordKind::number || reader.peek()->kind == WordKind::symbol;
                 });
    entry.right("hist delete 2").right("history delete 1 3").right("history delete");
    entry.wrong("hist delete 0", "delete must be at least 1, not 0");
    entry.wrong("hist delete all", "unexpected 'all' after the end of the command");
    return entry;
}

} // namespace

HistoryItem::Quantity recorded_quantity(std::string_view word) {
    for (const auto& item : recorded())
        for (const Spelling& s : item.words)
            if (s.word == word) return {item.kind, item.field, item.rate};
    throw std::logic_error("no quantity of histories has this word");
}

std::vector<std::pair<ObjectKind, std::string_view>> recorded_fields() {
    std::vector<std::pair<ObjectKind, std::string_view>> fields;
    for (const auto& item : recorded()) fields.emplace_back(item.kind, item.field);
    return fields;
}

Family history() {
    return {"history", "curves over cycles", {history_add(), history_write(), history_label(), history_delete()}};
}

} // namespace kaya::lang
