#include "io/difference.hpp"

#include "io/save.hpp"
#include "model/whole/state.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <vector>

namespace kaya {

namespace {

/// An archive that collects all numbers and texts of a state by name.
class Inventory final : public Archive {
public:
    std::map<std::string, std::vector<double>> all_numbers;
    std::map<std::string, std::string> texts;

    void numbers(std::string_view name, const Numbers& value) override {
        with_type(value, [&](const auto* first, std::size_t count) {
            all_numbers[path_ + std::string(name)].assign(first, first + count);
        });
    }
    void text(std::string_view name, std::string& text) override { texts[path_ + std::string(name)] = text; }
    void number_list(std::string_view name, NumberList& list) override { numbers(name, list.numbers()); }
    void numbers_column(std::string_view name, const Numbers& column, const Numbers&) override {
        numbers(name, column);
    }
    void rows(TableRows&) override {}
    void record_list(std::string_view name, RecordList& records) override {
        section(name, [&] {
            for (std::size_t k = 0; k < records.size(); ++k) section(std::to_string(k), [&] { records.visit(k); });
        });
    }
    void group(std::string_view name, const Visit& visit) override {
        const std::string before = path_;
        path_.append(name).append("/");
        visit();
        path_ = before;
    }
    void outside(const Visit& visit) override { visit(); }

private:
    std::string path_;
};

Inventory inventory_of(const std::string& file) {
    Model model;
    SaveExtras extras = restore_state(model, file);
    Inventory inventory;
    visit_state(inventory, model);
    for (auto* items : {&extras.scripts, &extras.decks})
        for (const auto& item : *items)
            inventory.texts[(items == &extras.decks ? "deck " : "script state ") + item.name] = item.content;
    inventory.texts["title"] = extras.title;
    return inventory;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

std::string about_numbers(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return fmt::format("{} numbers and {}", a.size(), b.size());
    std::size_t others = 0, worst = 0;
    double largest = -1;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (same(a[i], b[i])) continue;
        ++others;
        const double by = std::abs(a[i] - b[i]);
        if (largest < 0 || by > largest) largest = by, worst = i;
    }
    if (others == 0) return {};
    if (a.size() == 1) return fmt::format("{:g} and {:g}", a[0], b[0]);
    return fmt::format("{} of {} numbers differ, most of all {:g} and {:g} (number {})", others, a.size(), a[worst],
                       b[worst], worst);
}

/// Calls about(name, of a, of b) for each name of either map; null where one map lacks it.
template <class Value, class About>
void both(const std::map<std::string, Value>& a, const std::map<std::string, Value>& b, About about) {
    const Value* const none = nullptr;
    for (const auto& [name, value] : a) {
        const auto other = b.find(name);
        about(name, &value, other == b.end() ? none : &other->second);
    }
    for (const auto& [name, value] : b)
        if (!a.contains(name)) about(name, none, &value);
}

} // namespace

std::string save_file_difference(const std::string& first, const std::string& second) {
    const Inventory a = inventory_of(first), b = inventory_of(second);
    std::string text;
    const auto say = [&](const std::string& name, const std::string& what) {
        if (!what.empty()) text += fmt::format("{}: {}\n", name, what);
    };
    const auto only = [&](const void* of_a) { return fmt::format("only in '{}'", of_a ? first : second); };
    both(a.all_numbers, b.all_numbers,
         [&](const std::string& name, const std::vector<double>* one, const std::vector<double>* other) {
             say(name, one && other ? about_numbers(*one, *other) : only(one));
         });
    both(a.texts, b.texts, [&](const std::string& name, const std::string* one, const std::string* other) {
        constexpr std::size_t short_text = 60;
        if (!one || !other) say(name, only(one));
        else if (*one == *other) return;
        else if (std::max(one->size(), other->size()) > short_text || one->find('\n') != one->npos)
            say(name, "differs");
        else say(name, fmt::format("'{}' and '{}'", *one, *other));
    });
    return text;
}

} // namespace kaya
