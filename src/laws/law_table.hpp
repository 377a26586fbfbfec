// The description of a law, a joint model or a zone model: its table, checked once when it is loaded, with its texts copied, and then
// queried by name.
#pragma once

#include "kaya/zmodel.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

struct Called;

/// The two kinds of law.
struct LawKind {
    const char* noun;        ///< "joint model"
    const char* entry_point; ///< "kaya_joint_model"
    const char* header;      ///< "kaya/jmodel.h"
    const char* code;        ///< beginning of the codes of messages: "joint-model"
    unsigned interface_version;
    unsigned oldest_version; ///< of libraries that still load
};
extern const LawKind joint_law, zone_law;

class LawTable {
public:
    struct Property {
        std::string name;
        std::vector<std::string> aliases;
        std::string unit, help;
        double initial, minimum, maximum;  ///< initial is NaN when there is none
        bool optional;                     ///< with an initial NaN: the law gets NaN
        std::uint32_t reduction = 0;       ///< kaya_zreduction; of zone models
        kaya_jrole role = KAYA_JROLE_NONE; ///< of joint models

        /// Whether the property is optional.
        bool has_default() const { return optional || initial == initial; }
        /// Whether a value is within the limits; NaN is not.
        bool holds(double value) const { return value >= minimum && value <= maximum; }
        /// "at least 0", "from 0 to 90": the text after "must be".
        std::string limits_in_words() const;
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

    /// Names and aliases of all properties.
    std::vector<std::string_view> property_words() const;

    /// Properties that must be given and are not.
    std::vector<std::string> missing(const std::vector<double>& values) const;

    /// Its name for reports of crashes.
    const Called* who() const { return who_; }

    /// Records how it has changed the processor's arithmetic (ArithmeticChange), in any thread, and returns the record.
    void note_arithmetic(unsigned changes) const {
        if (changes != 0) *arithmetic_ |= changes;
    }
    unsigned arithmetic() const { return *arithmetic_; }

    /// Whether all its calls in cycles are fenced (guard_in_cycle); set between cycles.
    void fence_all_calls(bool all) { fences_all_ = all; }
    bool fences_all_calls() const { return fences_all_; }

protected:
    explicit LawTable(std::filesystem::path from) : file(std::move(from)) {}

    /// A copy of the descriptor; members added after its interface version are 0. Throws Diagnostic when it was made for a version that
    /// this program does not know, or has not the size of its version: its members would be at other positions.
    template <class Descriptor> Descriptor understood(const LawKind& kind, const Descriptor* descriptor) const;

    /// Checks and copies the table. Throws Diagnostic that names the invalid entry.
    template <class Descriptor> void read_table(const LawKind& kind, const Descriptor& descriptor);

    [[noreturn]] void refuse(const LawKind& kind, const std::string& what) const;

private:
    const Called* who_ = nullptr;
    bool fences_all_ = false;
    std::shared_ptr<std::atomic<unsigned>> arithmetic_ = std::make_shared<std::atomic<unsigned>>(0u);
};

extern template kaya_jmodel LawTable::understood(const LawKind&, const kaya_jmodel*) const;
extern template kaya_zmodel LawTable::understood(const LawKind&, const kaya_zmodel*) const;
extern template void LawTable::read_table(const LawKind&, const kaya_jmodel&);
extern template void LawTable::read_table(const LawKind&, const kaya_zmodel&);

} // namespace kaya
