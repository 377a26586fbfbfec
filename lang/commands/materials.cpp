// Properties and models of blocks and joints.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/commands/property_items.hpp"
#include "lang/commands/property_words.hpp"

#include <array>

namespace kaya::lang {

bool read_property_item(Reader& reader, std::vector<Property::Item>& items) {
    const Word& word = *reader.peek();
    if (word.kind != WordKind::word || word.text == "?") return false;
    const std::size_t index = static_cast<std::size_t>(&word - reader.statement().words.data());
    const auto& words = reader.statement().words;
    const Word* next = index + 1 < words.size() ? &words[index + 1] : nullptr;
    const bool number_follows = next && (next->kind == WordKind::number || next->late());
    const bool switch_follows = next && next->kind == WordKind::word && (next->folded == "on" || next->folded == "off");
    if (!number_follows && !switch_follows && !did_you_mean(word.folded, {"range", "model", "load"}).empty())
        return false;
    reader.take();
    Property::Item item{word.folded, 0, word.place, switch_follows};
    item.value = switch_follows ? reader.on_off(on_off().spec) : reader.real(real(word.folded).spec);
    items.push_back(std::move(item));
    return true;
}

namespace {

CommandSpec prop() {
    Entry<Property> entry({"property"});
    entry.help("gives a material its properties: of blocks, of joints, of joint models");
    const auto number = integer("n").at_least(1);
    entry.keyword({Spelling{"material", 1}, Spelling{"mat", 1}}, number,
                  Through{[](Property& p, std::int64_t n) { p.number = n, p.joint = false; },
                          [](const Property& p) { return p.joint ? std::nullopt : std::optional(p.number); }},
                  "number of the block material");
    entry.keyword({"jmaterial", "jmat"}, number,
                  Through{[](Property& p, std::int64_t n) { p.number = n, p.joint = true; },
                          [](const Property& p) { return p.joint ? std::optional(p.number) : std::nullopt; }},
                  "number of the joint material");
    for (const auto* table : {&block_property_words(), &joint_property_words()})
        for (const auto& known : *table) {
            auto value = real(known.words.front().word).unit(known.unit);
            if (table == &joint_property_words()) value.spec.limits.low = known.limits.low;
            entry.keyword(known.words,
                          Parts<Property>().in(next_of(&Property::items),
                                               Parts<Property::Item>()
                                                   .mark(&Property::Item::place)
                                                   .set(&Property::Item::word, std::string(value.spec.name))
                                                   .then(value, &Property::Item::value)),
                          known.help);
        }
    property_values(entry);
    entry.finish([](const Reader& reader, Property& property) {
        if (property.items.empty())
            incomplete_line(reader, "no property is given", "write for example: prop mat 1 dens 2600");
    });
    entry.right("prop mat=1 density = 0.0026 k=4e3 g=3e3").right("prop mat 1 jkn 1e2 jks 1e4 jfric 10 jcoh 5e3");
    entry.right("prop jmat 2 jkn 1e9 jks 1e9 jfriction 35 jten 0").right("prop mat 1 ymod 5e10 prat 0.25");
    entry.right("prop jmat 1 jrco 15 sigmac 150").right("prop m=2 d=2700");
    entry.wrong("prop mat 1", "no property is given");
    entry.wrong("prop mat 1 dens", "a number is missing after 'dens'");
    entry.wrong("prop mat 1 dens heavy", "expected a number, found 'heavy'");
    entry.wrong("prop jmat 1 jkn -1e9", "jkn must be at least 0, not -1e+09");
    entry.wrong("prop mat 1.5 dens 1", "mat takes a whole number, not 1.5");
    entry.wrong("prop mat 0 dens 1", "mat must be at least 1, not 0");
    entry.wrong("prop mat 1 dens 2600 1", "expected a keyword of property, found '1'");
    return entry;
}

CommandSpec change() {
    Entry<Change> entry({"change"});
    entry.help("gives blocks or contacts another material or constitutive number");
    entry.keyword({Spelling{"material", 1}, Spelling{"mat", 1}}, integer("n").at_least(1), &Change::material,
                  "material number of blocks");
    entry.keyword({"constitutive", "cons"}, integer("n").at_least(1), &Change::constitutive,
                  "constitutive number of blocks");
    entry.keyword({"jmaterial", "jmat"}, integer("n").at_least(1), &Change::joint_material,
                  "material number of contacts");
    entry.keyword({"jconstitutive", "jcons"}, integer("n").at_least(1), &Change::joint_constitutive,
                  "constitutive number of contacts");
    entry.range(&Change::range);
    entry.finish([](const Reader& reader, Change& c) {
        if (!c.material && !c.constitutive && !c.joint_material && !c.joint_constitutive)
            incomplete_line(reader, "change does not say what to change",
                            "expected: mat, cons, jmat or jcons and a number");
    });
    entry.right("change jmat 2 range z 0 1")
        .right("change jcons 1 jmat 3 range x 0 1")
        .right("chang cons 1 mat 2 range region 2");
    entry.right("change mat 2 region 2").right("change jmat 2 range mintersection 1 2");
    entry.wrong("change", "change does not say what to change");
    entry.wrong("change mat", "a number is missing after 'mat'");
    entry.wrong("change mat two", "expected a whole number, found 'two'");
    entry.wrong("change jmta 2", "'jmta' is not a keyword of change");
    return entry;
}

CommandSpec jmodel_load() {
    // In full only: `lo` and `mo...` may be properties of the model in use.
    return Entry<JointModelCommand>({"jmodel"}, {Spelling{"load", 4}})
        .help("loads a joint model from a shared library")
        .argument(text("name").help("name of the model or path of its library"),
                  named_model(JointModelCommand::Action::load))
        .finish([](const Reader& reader, JointModelCommand& c) { c.model_place = reader.previous().place; })
        .right("jmodel load barton-bandis")
        .wrong("jmodel load", "a word is missing after 'load'")
        .wrong("jmodel load a b", "unexpected 'b' after the end of the command");
}

CommandSpec jmodel_test() {
    Entry<JointModelTest> entry({"jmodel"}, {Spelling{"test", 4}});
    entry.help("drives one sub-contact of a joint model along a path and writes the response");
    entry.argument(text("name").help("name of the joint model"), &JointModelTest::model);
    entry.argument(text("file").help("CSV file of the path"), &JointModelTest::path);
    entry.keyword({"steps"}, integer("n").at_least(1).at_most(1e8), &JointModelTest::steps,
                  "steps between two points of the path; 1000");
    entry.keyword({"area"}, real("a").above(0).unit("area"), &JointModelTest::area, "area of the sub-contact; 1");
    property_values(entry);
    entry.start([](const Statement& statement, JointModelTest& c) {
        if (statement.words.size() > 2) c.model_place = statement.words[2].place;
    });
    entry.right("jmodel test mohr 'shear.csv' jkn 1e5 jks 1e4 jfric 30")
        .right("jmodel test mohr 'shear.csv' steps 100 jkn 1e5 jks 1e4");
    entry.wrong("jmodel test", "a word is missing after 'test'");
    entry.wrong("jmodel test mohr", "a word is missing after 'mohr'");
    entry.wrong("jmodel test mohr 'shear.csv' jkn", "a number is missing after 'jkn'");
    entry.wrong("jmodel test mohr 'shear.csv' steps 0", "steps must be at least 1, not 0");
    return entry;
}

CommandSpec jmodel_assign() {
    Entry<JointModelCommand> entry({"jmodel"}, {Spelling{"model", 3}, Spelling{"assign", 3}});
    entry.help("assigns a joint model to contacts, with optional properties");
    entry.start([](const Statement& statement, JointModelCommand& c) {
        c.action = JointModelCommand::Action::assign;
        if (statement.words.size() > 2) c.model_place = statement.words[2].place;
    });
    entry.argument(text("name").help("name of the joint model"), &JointModelCommand::model);
    property_values(entry);
    entry.range(&JointModelCommand::range, true);
    entry.right("jmodel model barton-bandis").right("jmodel model mohr jkn 1e5 jks 1e4 jfric 30 range z 0 1");
    entry.right("jmodel model softening-mohr jkn 1e5 jks 1e4 jfric 30 dc 0.01 healing off");
    entry.wrong("jmodel model", "a word is missing after 'model'");
    entry.wrong("jmodel model mohr jkn", "a number is missing after 'jkn'");
    entry.wrong("jmodel model mohr rang z 0 one", "'one' is not a range element");
    return entry;
}

CommandSpec jmodel_properties() {
    Entry<JointModelCommand> entry({"jmodel"});
    entry.help("sets properties of the joint model that contacts have");
    entry.otherwise({real("property value").optional().spec}, [](Reader& reader, JointModelCommand& c) {
        if (reader.statement().words.size() == 2 && reader.peek()->kind == WordKind::word &&
            did_you_mean(reader.peek()->folded, {"model", "load"}).empty())
            throw Diagnostic("jmodel needs a property and its value, or the word model",
                             "write for example: jmodel model " + reader.peek()->text)
                .at(reader.peek()->place);
        return read_property_item(reader, c.items);
    });
    entry.prints(property_items(&JointModelCommand::items), true);
    entry.range(&JointModelCommand::range, true);
    entry.finish([](const Reader& reader, JointModelCommand& c) {
        if (c.items.empty())
            incomplete_line(reader, "jmodel does not say what to do",
                            "expected: load NAME, model NAME, or a property and its value");
    });
    entry.right("jmodel jkn=1e5 jks=1e4 resfriction=20.0 jcso=100 nj = 0.8 lo = 0.1 ln=0.2");
    entry.right("jmodel jkn 1e5 range z 0");
    entry.wrong("jmodel", "jmodel does not say what to do");
    entry.wrong("jmodel mohr", "jmodel needs a property and its value, or the word model");
    entry.wrong("jmodel modle mohr", "'modle' is not a keyword of jmodel");
    entry.wrong("jmodel jkn 1e5 rnage z 0", "'rnage' is not a keyword of jmodel");
    return entry;
}

CommandSpec zone_load() {
    return Entry<ZoneModelCommand>({Spelling{"zone", 4}}, {Spelling{"load", 4}})
        .help("loads a zone model from a shared library")
        .argument(text("name").help("name of the zone model or path of its library"),
                  named_model(ZoneModelCommand::Action::load))
        .finish([](const Reader& reader, ZoneModelCommand& c) { c.model_place = reader.previous().place; })
        .right("zone load hoek-brown")
        .wrong("zone load", "a word is missing after 'load'");
}

CommandSpec zone_model() {
    Entry<ZoneModelCommand> entry({Spelling{"zone", 4}}, {Spelling{"model", 3}, Spelling{"cmodel", 4}});
    entry.help("assigns a zone model to the zones of blocks, with optional properties");
    entry.start([](const Statement& statement, ZoneModelCommand& c) {
        c.action = ZoneModelCommand::Action::assign;
        if (statement.words.size() > 2) c.model_place = statement.words[2].place;
    });
    entry.argument(text("name").help("name of the zone model"), &ZoneModelCommand::model);
    property_values(entry);
    entry.range(&ZoneModelCommand::range, true);
    entry.right("zone model mohr-coulomb").right("zone model mohr-coulomb cohesion 1e6 friction 35 range z 0 10");
    entry.right("zone model elastic range region 2");
    entry.wrong("zone model", "a word is missing after 'model'");
    entry.wrong("zone model mohr-coulomb cohesion", "a number is missing after 'cohesion'");
    return entry;
}

CommandSpec zone_properties() {
    Entry<ZoneModelCommand> entry({Spelling{"zone", 4}}, {Spelling{"property", 4}});
    entry.help("sets properties of the zone model that blocks have");
    property_values(entry);
    entry.range(&ZoneModelCommand::range, true);
    entry.finish([](const Reader& reader, ZoneModelCommand& c) {
        if (c.items.empty())
            incomplete_line(reader, "no property is given", "write for example: zone property cohesion 1e6");
    });
    entry.right("zone property bulk 5e9 shear 3e9 range region 2");
    entry.wrong("zone property", "no property is given");
    entry.wrong("zone property cohesion", "a number is missing after 'cohesion'");
    return entry;
}

CommandSpec zone_nmd() {
    return Entry<ZoneAveraging>({Spelling{"zone", 4}}, {"nmd"})
        .help("couples tetrahedra against locking: they average their volume strain and their flow")
        .argument(on_off(), &ZoneAveraging::on)
        .right("zone nmd off")
        .wrong("zone nmd maybe", "expected on or off, found 'maybe'");
}

} // namespace

Family materials() {
    return {"materials",
            "properties of blocks, zones and joints",
            {prop(), change(), jmodel_load(), jmodel_test(), jmodel_assign(), jmodel_properties(), zone_load(),
             zone_model(), zone_properties(), zone_nmd()}};
}

} // namespace kaya::lang
