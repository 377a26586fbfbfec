// Names available to scripts: functions and variables of FISH with their arguments, expressions for objects, fields of objects for Lua.
#pragma once

#include <string>
#include <vector>

namespace kaya::soak {

struct Vocabulary {
    struct Name {
        std::string name;
        int least = 0, most = 0; ///< arguments
        bool writable = false;
    };
    struct Kind {
        std::string name;                 ///< of Lua: "sub_contact"
        std::string prefix;               ///< of names of FISH: "cx"
        std::vector<std::string> fields;  ///< of Lua
        std::vector<std::string> objects; ///< expressions of FISH that give one
    };
    std::vector<Name> fish;
    std::vector<Kind> kinds;

    /// Of the program itself.
    Vocabulary();
    /// The kind whose objects a function takes as argument; null: none.
    const Kind* kind_of(const std::string& name) const;
};

} // namespace kaya::soak
