// What a law says of itself, be it a joint model or a zone model: its table, checked once when it is loaded, with its texts
// copied, and then asked by name.
#pragma once

#include "kaya/zmodel.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// The two kinds of law.
struct LawKind {
    const char* noun;          ///< "joint model"
    const char* entry_point;   ///< "kaya_joint_model"
    const char* header;        ///< "kaya/jmodel.h"
    const char* code;          ///< beginning of the codes of messages: "joint-model"
    unsigned interface_version;
};
extern const LawKind joint_law, zone_law;

class LawTable {
public:
    struct Property {
        std::string name;
        std::vector<std::string> aliases;
        std::string unit, help;
        double initial, minimum, maximum; ///< initial is NaN when there is none
        bool optional;                    ///< with an initial NaN: the law gets NaN
        std::uint32_t reduction = 0;      ///< kaya_zreduction

        /// Whether a law can do without being given one.
        bool has_default() const { return optional || initial == initial; }
    };
    struct HistoryVariable {
        std::string name, unit, help;
    };

    std::string name, title, version;
    std::filesystem::path file;
    std::vector<Property> properties;
    std::vector<HistoryVariable> history;
    std::vector<std::string> states;

    /// Index of the property with that name or alias (case folded, any unambiguous leading part), or none.
    std::optional<std::size_t> find_property(std::string_view word) const;

    /// Properties that must be given and are not.
    std::vector<std::string> missing(const std::vector<double>& values) const;

protected:
    explicit LawTable(std::filesystem::path from) : file(std::move(from)) {}

    /// Throws Diagnostic when version or size are others than those of this program: the rest lies elsewhere then.
    template <class Descriptor> void refuse_other_interface(const LawKind& kind, const Descriptor* descriptor) const;

    /// Checks and copies the table. Throws Diagnostic that says which entry is wrong.
    template <class Descriptor> void read_table(const LawKind& kind, const Descriptor& descriptor);

    [[noreturn]] void refuse(const LawKind& kind, const std::string& what) const;
};

extern template void LawTable::refuse_other_interface(const LawKind&, const kaya_jmodel*) const;
extern template void LawTable::refuse_other_interface(const LawKind&, const kaya_zmodel*) const;
extern template void LawTable::read_table(const LawKind&, const kaya_jmodel&);
extern template void LawTable::read_table(const LawKind&, const kaya_zmodel&);

} // namespace kaya
