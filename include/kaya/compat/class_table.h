/* SPDX-License-Identifier: MIT */
/* What a class derived from jmodels::JointModel says of itself, as the texts and numbers of a descriptor. For adapter.cpp only. */
#ifndef KAYA_COMPAT_CLASS_TABLE_H
#define KAYA_COMPAT_CLASS_TABLE_H

#include "kaya/compat/jointmodel.h"
#include "kaya/jmodel.h"

#include <cctype>
#include <cstddef>

extern "C" {
__attribute__((weak)) const char* getName();
__attribute__((weak)) unsigned getMajorVersion();
__attribute__((weak)) unsigned getMinorVersion();
__attribute__((weak)) void* createInstance();
}

namespace {

using base::Property;
using jmodels::JointModel;
using jmodels::State;
typedef std::vector<std::string> Words;

constexpr UByte dimensions = 3;
constexpr UInt from_command = 0, from_restore = 1;

/* ----- lists of names ----- */

std::string lower(std::string word) {
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return word;
}

/* A word that can be typed in a deck: letters, digits, hyphens and underscores, a letter first. */
std::string typeable(const std::string& word) {
    std::string kept;
    for (const char c : lower(word))
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
            if (!kept.empty() || std::isalpha(static_cast<unsigned char>(c))) kept += c;
    return kept;
}

Words blank_separated(const std::string& list) {
    std::istringstream stream(list);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/* The items between commas, each with its words; empty items count, since indices do. A comma at the end
 * of the list begins no item. */
std::vector<Words> items_of(const std::string& list) {
    std::vector<Words> items;
    std::string::size_type first = 0;
    while (first <= list.size()) {
        const auto comma = std::min(list.find(',', first), list.size());
        items.push_back(blank_separated(list.substr(first, comma - first)));
        first = comma + 1;
    }
    while (!items.empty() && items.back().empty()) items.pop_back();
    return items;
}

std::string joined(const Words& words, char between) {
    std::string all;
    for (const auto& word : words) {
        if (!all.empty()) all += between;
        all += word;
    }
    return all;
}

/* ----- what the class says of itself ----- */

/* One number of the deck: a property of the class, or one component of one that is a vector. */
struct Slot {
    UInt index;
    Property::Kind kind;
    int component;
};

double number_of(const Property& value, const Slot& slot) {
    if (slot.kind == Property::Kind::vector) {
        const DVect3 v = value.toVector();
        return slot.component == 0 ? v.x() : slot.component == 1 ? v.y() : v.z();
    }
    if (slot.kind == Property::Kind::text && value.toString().empty()) return std::nan("");
    return value.toDouble();
}

struct DestroyModel {
    void operator()(JointModel* model) const {
        if (model) model->destroy();
    }
};
typedef std::unique_ptr<JointModel, DestroyModel> ModelPointer;

ModelPointer new_instance() { return ModelPointer(static_cast<JointModel*>(createInstance())); }

/* Texts live here as long as the library: the descriptor points at them. */
struct Metadata {
    std::string name, title, version, states;
    std::vector<Slot> slots;
    std::vector<std::string> names, aliases, units, help;
    std::vector<kaya_jproperty> properties;
    std::vector<double> initial;
    std::vector<std::string> energy_names;
    std::vector<kaya_jhistory> energies;
    UInt minor = 0;
    ModelPointer pattern;
};

Metadata* metadata = nullptr;

void set_property(JointModel& model, const Slot& slot, double value, UInt version) {
    Property property(value);
    switch (slot.kind) {
    case Property::Kind::truth: property = Property(value != 0); break;
    case Property::Kind::whole: property = Property(static_cast<long long>(value)); break;
    case Property::Kind::text:
        property = Property(std::isnan(value) ? std::string() : std::string(Property(value).toString()));
        break;
    case Property::Kind::vector: {
        DVect3 v = model.getProperty(slot.index).toVector();
        (slot.component == 0 ? v.rx() : slot.component == 1 ? v.ry() : v.rz()) = value;
        property = Property(v);
        break;
    }
    default: break;
    }
    model.setProperty(slot.index, property, version);
}

void add_slot(Metadata& m, UInt index, const Words& words, const Property& value, int component,
              std::vector<std::string>& taken) {
    static const char* const ending[] = {"-x", "-y", "-z"};
    const bool vector = value.kind() == Property::Kind::vector;
    Words free;
    for (const auto& word : words) {
        std::string name = typeable(word);
        if (name.empty()) continue;
        if (vector) name += ending[component];
        /* The first property that claims a word has it. */
        if (std::find(taken.begin(), taken.end(), name) != taken.end()) continue;
        taken.push_back(name);
        free.push_back(name);
    }
    if (free.empty()) return;
    const Slot slot{index, value.kind(), component};
    m.slots.push_back(slot);
    m.initial.push_back(number_of(value, slot));
    m.names.push_back(free.front());
    m.aliases.push_back(joined(Words(free.begin() + 1, free.end()), ' '));
    m.help.push_back(value.kind() == Property::Kind::text    ? "number of a table"
                     : value.kind() == Property::Kind::truth ? "0: no, 1: yes"
                                                             : "");
}

Metadata read_metadata() {
    Metadata m;
    m.pattern = new_instance();
    if (!m.pattern) throw std::runtime_error("createInstance() gives no object");
    const JointModel& model = *m.pattern;
    m.name = typeable(joined(blank_separated(model.getName()), '-'));
    m.title = model.getFullName();
    m.minor = model.getMinorVersion();
    m.version = std::to_string(getMajorVersion()) + "." + std::to_string(getMinorVersion ? getMinorVersion() : m.minor);

    std::vector<std::string> taken;
    const auto items = items_of(model.getProperties());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const UInt index = static_cast<UInt>(i + 1);
        const Property value = model.getProperty(index);
        const int components = value.kind() == Property::Kind::vector ? 3 : 1;
        for (int c = 0; c < components; ++c) add_slot(m, index, items[i], value, c, taken);
    }
    for (std::size_t k = 0; k < m.slots.size(); ++k) {
        const double initial = std::isfinite(m.initial[k]) ? m.initial[k] : std::nan("");
        m.properties.push_back(
            {m.names[k].c_str(), m.aliases[k].c_str(), "-", m.help[k].c_str(), initial, -INFINITY, INFINITY, 1});
        m.initial[k] = initial;
    }
    const auto states = items_of(model.getStates());
    for (std::size_t bit = 0; bit < states.size(); ++bit) {
        const auto name = states[bit].empty() ? "bit-" + std::to_string(bit) : lower(joined(states[bit], '-'));
        m.states += (bit > 0 ? " " : "") + name;
    }
    for (const auto& words : items_of(m.pattern->getEnergies())) m.energy_names.push_back(lower(joined(words, '-')));
    for (const auto& name : m.energy_names)
        m.energies.push_back({name.c_str(), "energy", "energy that the model reports"});
    return m;
}

} // namespace

#endif
