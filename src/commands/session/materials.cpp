// prop, change, jmodel.
#include "commands/session/materials.hpp"
#include "commands/session/all_or_nothing.hpp"

#include "commands/session/plausible.hpp"
#include "commands/review/property_meaning.hpp"
#include "commands/review/zone_moduli.hpp"

#include "commands/session/handlers.hpp"
#include "commands/session/new_contacts.hpp"
#include "jointtest/bench.hpp"
#include "lang/commands/language.hpp"
#include "laws/given_values.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/common/property_sets.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

using Items = std::vector<lang::Property::Item>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Members of a material for the properties of blocks.
constexpr std::array<double Material::*, lang::block_property_count> members{
    &Material::density,  &Material::bulk,     &Material::shear,   &Material::young,   &Material::poisson,
    &Material::cohesion, &Material::friction, &Material::tension, &Material::dilation};

double Material::*member_of(lang::BlockProperty property) { return members[static_cast<std::size_t>(property)]; }

/// Drops a value that was given before under another spelling of the same word: jfric, jfriction.
void forget_other_spellings(std::map<std::string, double>& values, const std::string& word) {
    std::erase_if(values, [&](const auto& entry) {
        return entry.first != word && whole_joint_word(entry.first) == whole_joint_word(word);
    });
}

void set_block_property(Material& material, lang::BlockProperty property, const lang::Property::Item& item) {
    check_value(property, item);
    material.*member_of(property) = item.value;
    // The pair given last counts.
    using enum lang::BlockProperty;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (property == bulk || property == shear) material.young = material.poisson = nan;
    if (property != young && property != poisson) return;
    const bool both = !std::isnan(material.young) && !std::isnan(material.poisson);
    material.bulk = both ? bulk_modulus(material.young, material.poisson) : nan;
    material.shear = both ? shear_modulus(material.young, material.poisson) : nan;
}

/// `on` and `off` are 1 and 0 of properties that have no other values.
void refuse_wrong_switch(const JointRegistry& joints, const Items& items) {
    for (const auto& item : items) {
        if (!item.is_switch) continue;
        const bool is_known = std::ranges::any_of(joints.loaded(), [&](const auto& model) {
            const auto found = model->find_property(item.word);
            return found && model->properties[*found].minimum == 0 && model->properties[*found].maximum == 1;
        });
        if (!is_known)
            throw Diagnostic(fmt::format("'{}' cannot be switched on or off", item.word), "give it a number")
                .at(item.place);
    }
}

std::vector<std::pair<std::string, double>> names_and_values(const Items& items) {
    std::vector<std::pair<std::string, double>> pairs;
    for (const auto& item : items) pairs.emplace_back(item.word, item.value);
    return pairs;
}

/// Calls `give(failed)`; a mistake in item number `failed` is reported at its word.
template <class Give> void pointing_at(const Items& items, Give give) {
    std::size_t failed = items.size();
    try {
        give(&failed);
    } catch (Diagnostic& mistake) {
        if (failed < items.size()) mistake.at(items[failed].place);
        throw;
    }
}

void check_elastic_pair(std::int32_t number, const Material& material) {
    const bool young = !std::isnan(material.young), poisson = !std::isnan(material.poisson);
    if (young == poisson) return;
    throw Diagnostic(
        fmt::format("material {} has {} but no {}", number, young ? "ymod" : "prat", young ? "prat" : "ymod"),
        "the stiffness of a block needs both, or bulk and shear");
}

/// Joint models that contacts with this joint material use.
std::set<std::string> models_in_use(const Model& model, std::int32_t material) {
    std::set<std::string> names;
    for (std::size_t row = 0; row < model.contacts.size(); ++row)
        if (model.contacts.material[row] == material && model.contacts.properties[row] != no_row)
            names.insert(model.joint_properties[model.contacts.properties[row]].model);
    return names;
}

void warn_unused(Session& session, std::int32_t number, const Material& material) {
    const auto models = models_in_use(session.engine.model, number);
    if (models.empty()) return;
    for (const auto& [word, value] : material.joint) {
        const bool known = std::ranges::any_of(models, [&, &name = word](const std::string& model) {
            const JointModel* found = session.engine.joints.find(model);
            return found == nullptr || found->find_property(name).has_value();
        });
        if (known) continue;
        if (!session.program.said_once.insert(fmt::format("prop {} {} {}", number, word, *models.begin())).second)
            continue;
        const auto place = session.deck.property_words.find({number, word});
        Diagnostic warning(fmt::format("'{}' of joint material {} has no effect", word, number),
                           fmt::format("joint model {} has no such property", fmt::join(models, ", ")));
        if (place != session.deck.property_words.end()) warning.at(place->second.place);
        session.warn(std::move(warning));
    }
}

/// Words of zones that no zone model in use has: a deck that asks for yielding rock must not get elastic rock silently.
void warn_unused_by_zones(Session& session, std::int32_t number, const Material& material) {
    const auto models = zone_models_in_use(session.engine.model, number);
    const auto& used = session.engine.model.blocks.material;
    if (models.empty() && std::ranges::find(used, number) == used.end()) return;
    std::map<std::string, double> words = material.zone;
    using enum lang::BlockProperty;
    for (const auto property : {cohesion, friction, tension, dilation})
        if (material.*member_of(property) != 0) words.emplace(name_of(property), material.*member_of(property));
    for (const auto& [word, value] : words) {
        const bool known = std::ranges::any_of(models, [&, &name = word](const std::string& model) {
            return session.engine.joints.zones.get(model).find_property(name).has_value();
        });
        const std::string by = models.empty() ? "rigid" : *models.begin();
        if (known || !session.program.said_once.insert(fmt::format("zone prop {} {} {}", number, word, by)).second)
            continue;
        const auto place = session.deck.property_words.find({number, word});
        Diagnostic warning =
            models.empty()
                ? Diagnostic(
                      fmt::format("'{}' of material {} has no effect on cycles: its blocks are rigid", word, number),
                      "rock that yields needs zones: generate edge ..., and `change cons 2`; `limit equilibrium` "
                      "knows the strength of rigid blocks")
                : Diagnostic(
                      fmt::format("'{}' of material {} has no effect on cycles: its zones are {}", word, number,
                                  fmt::join(models, ", ")),
                      "zones that yield need a zone model that has it: `change cons 2` or `zone model mohr-coulomb`");
        if (place != session.deck.property_words.end()) warning.at(place->second.place);
        session.warn(std::move(warning));
    }
}

/// Throws Diagnostic where `zone model` was given and no block that has one has zones.
void refuse_rigid_models(const Model& model) {
    const auto& blocks = model.blocks;
    Row first = no_row;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.zone_properties[b] == 0) continue;
        if (blocks.deformable[b]) return;
        if (first == no_row) first = static_cast<Row>(b);
    }
    if (first == no_row) return;
    const auto& given = model.zone_properties[static_cast<std::size_t>(blocks.zone_properties[first])];
    Diagnostic mistake(
        fmt::format("block {} is rigid: its zone model {} has no effect", blocks.number[first], given.model),
        "give it zones before the run (generate edge ...), or leave out `zone model`");
    if (!given.place.empty()) mistake.add("its zone model was given at " + given.place);
    throw mistake;
}

/// A zone model that was given to blocks without zones, beside others with zones or by its number.
void warn_of_rigid_models(Session& session) {
    refuse_rigid_models(session.engine.model);
    const auto& blocks = session.engine.model.blocks;
    std::size_t rigid = 0;
    Row first = no_row;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const bool yields = blocks.zone_properties[b] != 0 || blocks.constitutive[b] > 1;
        if (blocks.deformable[b] || !yields) continue;
        if (rigid++ == 0) first = static_cast<Row>(b);
    }
    if (rigid == 0 || !session.program.said_once.insert("rigid zone model").second) return;
    const std::string name = zone_model_of(session.engine.model, first);
    session.warn(Diagnostic(
        rigid == 1 ? fmt::format("block {} is rigid: its zone model {} has no effect", blocks.number[first], name)
                   : fmt::format("{} blocks are rigid, block {} among them: their zone model {} has "
                                 "no effect",
                                 rigid, blocks.number[first], name),
        "give them zones before the run: generate edge ..."));
}

/// Values of joints that their future model refuses: reported where they were given.
void refuse_joint_values(Session& session, std::int32_t number, const Material& material) {
    std::set<std::string> models = models_in_use(session.engine.model, number);
    if (models.empty() && session.engine.model.contacts.empty())
        models.insert(default_joint_model(session.engine.model));
    for (const auto& name : models) {
        const JointModel* joint = &session.engine.joints.get(name);
        for (const auto& [word, value] : material.joint) {
            const auto place = session.deck.property_words.find({number, word});
            if (!joint->find_property(word) || place == session.deck.property_words.end()) continue;
            try {
                accepting_property(*joint, joint_law.noun, word, value);
            } catch (Diagnostic& mistake) {
                mistake.at(place->second.place);
                throw;
            }
        }
    }
}

} // namespace

void run(Session& session, const lang::Property& typed) {
    lang::Property command = typed;
    command.items = session.deck.given_properties.replaced(std::move(command.items), command.number);
    const auto number = static_cast<std::int32_t>(command.number);
    refuse_wrong_switch(session.engine.joints, command.items);
    doubt_angles(session, command.items);
    const auto existing = session.engine.model.materials.find(number);
    Material material = existing == session.engine.model.materials.end() ? Material{} : existing->second;
    Items of_joints;
    for (const auto& item : command.items) {
        const PropertyMeaning meaning = property_meaning(session.engine.joints, item, command.joint);
        if (meaning.block) {
            set_block_property(material, *meaning.block, item);
            session.deck.property_words[{number, std::string(name_of(*meaning.block))}] = {item.place};
        } else if (meaning.zone) {
            check_value(*meaning.zone, item);
            material.zone[meaning.zone->name] = item.value;
            session.deck.property_words[{number, meaning.zone->name}] = {item.place};
        } else {
            of_joints.push_back(item);
            of_joints.back().word = meaning.joint;
        }
    }
    if (!of_joints.empty()) {
        pointing_at(of_joints, [&](std::size_t* failed) {
            set_joint_material(session.engine.model, session.engine.joints, number, names_and_values(of_joints),
                               session.deck.here(), failed);
        });
        for (const auto& item : of_joints) {
            session.deck.property_words[{number, item.word}] = {item.place, command.joint};
            forget_other_spellings(session.engine.model.materials[number].joint, item.word);
        }
    }
    material.joint = session.engine.model.materials[number].joint;
    session.engine.model.materials[number] = std::move(material);
    ModelEdit(session.engine.model, Change::properties);
}

void run(Session& session, const lang::Change& command) {
    auto& model = session.engine.model;
    refuse_unknown_number(command);
    if (command.material || command.constitutive)
        for (const Row block : session.pick(ObjectKind::block, command.range)) {
            if (command.material) model.blocks.material[block] = static_cast<std::int32_t>(*command.material);
            if (command.constitutive) {
                const auto number = static_cast<std::int32_t>(*command.constitutive);
                auto& given = model.blocks.zone_properties[block];
                if (given != 0 || model.blocks.constitutive[block] != number) forget_zones(model, block);
                given = 0;
                model.blocks.constitutive[block] = number;
            }
            ModelEdit(model, Change::properties);
        }
    if (!command.joint_material && !command.joint_constitutive) return;

    const auto contacts = session.pick(ObjectKind::contact, command.range);
    if (contacts.empty()) return;
    if (command.joint_constitutive) {
        const auto number = static_cast<std::int32_t>(*command.joint_constitutive);
        assign_joint_model(model, session.engine.joints, contacts, joint_model_of_number(model, number),
                           session.deck.here());
    }
    if (command.joint_material)
        change_joint_material(model, session.engine.joints, contacts,
                              static_cast<std::int32_t>(*command.joint_material), session.deck.here());
}

namespace {

/// Gives existing or future joints in range the model and the values of the command.
void change_joint_model(Session& session, const lang::JointModelCommand& command) {
    using Action = lang::JointModelCommand::Action;
    refuse_wrong_switch(session.engine.joints, command.items);
    doubt_angles(session, command.items);
    find_joints(session);
    // Without any contact yet, a command for all contacts applies to future ones.
    const bool to_come = !command.range.place && select(session.engine.model, ObjectKind::contact, {}, true).empty();
    const auto contacts = to_come ? std::vector<Row>{} : session.pick(ObjectKind::contact, command.range);
    if (contacts.empty() && !to_come) return;
    if (command.action == Action::assign) {
        try {
            assign_joint_model(session.engine.model, session.engine.joints, contacts,
                               session.engine.joints.get(command.model).name, session.deck.here());
        } catch (Diagnostic& mistake) {
            mistake.at(command.model_place);
            throw;
        }
    }
    if (command.items.empty()) return;
    pointing_at(command.items, [&](std::size_t* failed) {
        set_joint_properties(session.engine.model, session.engine.joints, contacts, names_and_values(command.items),
                             session.deck.here(), failed);
    });
}

} // namespace

void run(Session& session, const lang::JointModelCommand& typed) {
    lang::JointModelCommand command = typed;
    command.items = session.deck.given_properties.replaced(std::move(command.items), GivenProperties::of_jmodel);
    using Action = lang::JointModelCommand::Action;
    if (command.action != Action::properties) {
        try {
            session.engine.joints.get(command.model);
        } catch (Diagnostic& mistake) {
            mistake.at(command.model_place);
            throw;
        }
        if (command.action == Action::load) return;
    }
    all_or_nothing(session, [&] { change_joint_model(session, command); });
}

void run(Session& session, const lang::JointModelTest& command) {
    BenchOrder order;
    order.model = command.model;
    order.path = command.path;
    order.before_writing = [&](const std::filesystem::path& file) { session.program.gate->may_write(file); };
    order.values = names_and_values(command.items);
    order.settings.steps = static_cast<std::size_t>(command.steps);
    order.settings.area = command.area;
    session.program.gate->may_read(order.path);
    try {
        const auto report = run_bench(session.engine.joints, order);
        session.program.output.print(report.text);
    } catch (Diagnostic& mistake) {
        mistake.at(command.model_place);
        throw;
    }
}

double material_value(const Model& model, const JointRegistry& joints, std::int64_t number, std::string_view word) {
    const auto property = find_block_property(word);
    if (!property && !is_joint_word(joints, word))
        throw Diagnostic(fmt::format("'{}' is not a property of blocks, nor of joints", word), {}, Fault::run);
    const auto found = model.materials.find(static_cast<std::int32_t>(number));
    if (found == model.materials.end()) return 0;
    if (property) {
        const double value = found->second.*member_of(*property);
        return std::isnan(value) ? 0 : value;
    }
    for (const auto& [name, value] : found->second.joint)
        if (name == word || whole_joint_word(name) == whole_joint_word(word)) return value;
    return 0;
}

std::set<std::string> zone_models_in_use(const Model& model, std::optional<std::int32_t> material) {
    std::set<std::string> names;
    for (std::size_t b = 0; b < model.blocks.size(); ++b)
        if (model.blocks.deformable[b] && (!material || model.blocks.material[b] == *material))
            names.insert(zone_model_of(model, static_cast<Row>(b)));
    return names;
}

std::set<Row> property_sets_in_use(const Model& model) {
    std::set<Row> rows(model.contacts.properties.begin(), model.contacts.properties.end());
    rows.erase(no_row);
    return rows;
}

void check_materials(Session& session) {
    std::set<std::int32_t> in_use(session.engine.model.blocks.material.begin(),
                                  session.engine.model.blocks.material.end());
    for (const auto& [number, material] : session.engine.model.materials) {
        if (in_use.contains(number)) check_elastic_pair(number, material);
        refuse_joint_values(session, number, material);
        warn_unused(session, number, material);
        warn_unused_by_zones(session, number, material);
    }
    warn_of_rigid_models(session);
    doubt_elasticity(session);
    doubt_densities(session);
    doubt_weight(session);
    doubt_units(session);
}

void add_handlers(HandlerTable& table, lang::MaterialCommands list) { fill(table, list); }

} // namespace kaya
