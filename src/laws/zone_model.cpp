#include "laws/zone_model.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"
#include "laws/arithmetic.hpp"
#include "laws/trespass.hpp"
#include "system/crash_report.hpp"
#include "system/library_file.hpp"
#include "system/loaded_library.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <set>

namespace kaya {

namespace fs = std::filesystem;

namespace {

constexpr const char* library_ending = ".so";

[[noreturn]] void refuse(const char* code, std::string message, std::string hint) {
    Diagnostic error(std::move(message), std::move(hint));
    error.code = code;
    throw error;
}

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::equivalent(a, b, ignored);
}

void refuse_other_files(const fs::path& file) {
    if (const auto fault = fault_of_library_file(file); !fault.empty())
        refuse("zone-model-not-a-library", fmt::format("{} {}", file.string(), fault),
               "build it with kaya_add_zone_model in CMake, or with c++ -shared -fPIC");
}

/// `name` is that by which the loader opens the file.
std::unique_ptr<ZoneModel> open(const fs::path& file, const fs::path& name) {
    const Called* who = called(file.filename().string(), file.string(), zone_law.noun);
    if (const auto fault = fault_of_loading(name, zone_law.entry_point, who); !fault.empty())
        refuse(
            "zone-model-crashes", fmt::format("zone model {} {}", file.string(), fault),
            "look at what its source does before any of its functions is called: static objects, the functions that describe it");
    const AtWork at_work(who, zone_law.entry_point);
    ArithmeticGuard arithmetic; // a library that was linked with -ffast-math changes it when it is loaded
    std::string fault;
    const auto library = load_library(name, who, fault);
    if (!library) refuse("zone-model-not-a-library", fmt::format("{} could not be loaded", file.string()), fault);
    using Entry = const kaya_zmodel* (*)();
    const auto entry = reinterpret_cast<Entry>(symbol_of(library.get(), zone_law.entry_point));
    if (!entry)
        refuse("zone-model-no-entry",
               fmt::format("{} is not a zone model: it has no function {}", file.string(), zone_law.entry_point),
               "include kaya/zmodel.h and define that function with C linkage");
    auto model = std::make_unique<ZoneModel>(entry(), file, library);
    model->note_arithmetic(arithmetic.put_back());
    return model;
}

bool all_finite(const double* column, std::size_t n) {
    std::uint64_t others = 0; // counted and not compared one by one, so that it is a vector loop
    for (std::size_t i = 0; i < n; ++i) others += !(std::abs(column[i]) <= std::numeric_limits<double>::max());
    return others == 0;
}

std::optional<ZoneFailure> not_finite(std::string_view model, std::string_view quantity, const double* column,
                                      std::size_t n) {
    if (all_finite(column, n)) return std::nullopt;
    const auto row = std::find_if(column, column + n, [](double value) { return !std::isfinite(value); });
    return ZoneFailure{static_cast<std::size_t>(row - column),
                       fmt::format("zone model {} returned {} {}", model, quantity, *row)};
}

} // namespace

ZoneModel::ZoneModel(const kaya_zmodel* descriptor, fs::path from, std::shared_ptr<void> library)
    : LawTable(std::move(from)), descriptor_(understood(zone_law, descriptor)), library_(std::move(library)) {
    const kaya_zmodel* d = &descriptor_;
    const std::pair<const char*, bool> parts[] = {
        {"name", d->name != nullptr}, {"run", d->run != nullptr}, {"moduli", d->moduli != nullptr}};
    for (const auto& [part, is_there] : parts)
        if (!is_there) LawTable::refuse(zone_law, fmt::format("'{}' is NULL", part));
    read_table(zone_law, *d);
}

std::string ZoneModel::check(const std::vector<double>& values) const {
    if (!descriptor_.check) return {};
    const AtWork at_work(who(), "check");
    try {
        const char* complaint = descriptor_.check(values.data());
        return complaint ? complaint : "";
    } catch (const std::exception& thrown) {
        return fmt::format("zone model {} threw an exception from check(): {}", name, thrown.what());
    } catch (...) { return fmt::format("zone model {} threw an exception from check()", name); }
}

ZoneModuli ZoneModel::moduli(const std::vector<double>& values) const {
    ZoneModuli moduli{std::nan(""), std::nan("")};
    std::string reason;
    const AtWork at_work(who(), "moduli");
    try {
        descriptor_.moduli(values.data(), &moduli.bulk, &moduli.shear);
    } catch (const std::exception& thrown) {
        reason = fmt::format("it threw an exception: {}", thrown.what());
    } catch (...) { reason = "it threw an exception"; }
    if (reason.empty() && !(std::isfinite(moduli.bulk) && moduli.bulk > 0))
        reason = fmt::format("the bulk modulus is {}; it must be above 0", moduli.bulk);
    if (reason.empty() && !(std::isfinite(moduli.shear) && moduli.shear > 0))
        reason = fmt::format("the shear modulus is {}; it must be above 0", moduli.shear);
    if (reason.empty()) return moduli;
    Diagnostic error(fmt::format("zone model {} gives no moduli to compute a time step from", name),
                     "give the zones their moduli, or correct moduli() of the model", Fault::run);
    error.code = "zone-model-moduli";
    throw error.add(reason);
}

namespace {

std::optional<ZoneFailure> unusable_output(const ZoneModel& model, const kaya_zbatch& batch) {
    static constexpr const char* stresses[6] = {"xx stress", "yy stress", "zz stress",
                                                "xy stress", "xz stress", "yz stress"};
    for (int k = 0; k < 6; ++k)
        if (auto failure = not_finite(model.name, stresses[k], batch.stress[k], batch.n)) return failure;
    if (auto failure = not_finite(model.name, "dissipation", batch.dissipation, batch.n)) return failure;
    for (std::size_t k = 0; k < model.history.size(); ++k)
        if (auto failure = not_finite(model.name, model.history[k].name, batch.history[k], batch.n)) return failure;
    return std::nullopt;
}

} // namespace

std::optional<ZoneFailure> ZoneModel::run(kaya_zbatch& batch, std::int32_t first, const std::int32_t* numbers) const {
    batch.message[0] = '\0';
    batch.row = batch.n;
    batch.tables = tables;
    const AtWork at_work(who(), "run",
                         {.rows = batch.n, .row = &batch.row, .numbers = numbers, .first = first, .noun = "zone"});
    const kaya_zbatch before = batch;
    const std::uint64_t values = sum_of_bits(batch.properties, properties.size());
    ArithmeticGuard arithmetic;
    ptrdiff_t row = -1;
    try {
        row = descriptor_.run(&batch);
    } catch (const std::exception& thrown) {
        return ZoneFailure{
            0, fmt::format("zone model {} threw an exception in a batch that begins here: {}", name, thrown.what())};
    } catch (...) {
        return ZoneFailure{
            0,
            fmt::format("zone model {} threw something other than a std::exception in a batch that begins here", name)};
    }
    note_arithmetic(arithmetic.put_back());
    if (is_other_batch(before, batch)) {
        batch = before;
        return ZoneFailure{0, fmt::format("zone model {} wrote to the table of its columns", name), true};
    }
    if (sum_of_bits(batch.properties, properties.size()) != values)
        return ZoneFailure{0, fmt::format("zone model {} wrote to 'properties', which it may only read", name), true};
    if (row == -1) return unusable_output(*this, batch);
    if (row < 0 || static_cast<std::size_t>(row) >= batch.n)
        return ZoneFailure{0, fmt::format("zone model {} returned row {} of a batch of {} rows, which begins here",
                                          name, row, batch.n)};
    const std::string_view message(batch.message, strnlen(batch.message, KAYA_JMODEL_MESSAGE));
    return ZoneFailure{static_cast<std::size_t>(row),
                       fmt::format("zone model {} failed: {}", name, message.empty() ? "it gives no reason" : message)};
}

std::vector<fs::path> with_zone_folders(const std::vector<fs::path>& folders) {
    std::vector<fs::path> all;
    for (const auto& folder : folders) {
        all.push_back(folder);
        const fs::path named = folder.filename().empty() ? folder.parent_path() : folder;
        if (named.filename() == "joints") all.push_back(named.parent_path() / "zones");
    }
    return all;
}

const ZoneModel& ZoneModels::get(std::string_view name) {
    if (name.find('/') != name.npos || name.ends_with(library_ending)) {
        fs::path file(name);
        for (const auto& folder : path_)
            if (!is_there(file) && !file.is_absolute() && is_there(folder / name)) file = folder / name;
        return load(file);
    }
    const std::string keyword = lower_case(name);
    if (const auto* model = find(keyword)) return *model;
    if (const auto file = file_of(keyword)) {
        try {
            return load(*file);
        } catch (const Diagnostic& refusal) {
            // A joint model has that name: the zone model is another one.
            if (refusal.code != "zone-model-no-entry" || file->parent_path().filename() == "zones") throw;
        }
    }
    const auto names = available();
    const auto near = did_you_mean(keyword, {names.begin(), names.end()});
    Diagnostic error(fmt::format("there is no zone model '{}'", name),
                     near.empty() ? "give one of the names below, or the file of a zone model"
                                  : fmt::format("did you mean '{}'?", near));
    error.code = "zone-model-unknown";
    error.add(names.empty() ? "no zone models were found in the folders that are searched"
                            : fmt::format("zone models: {}", fmt::join(names, ", ")));
    throw error;
}

const ZoneModel& ZoneModels::load(const fs::path& file) {
    for (const auto& model : models_)
        if (same_file(model->file, file)) return *model;
    if (!is_there(file))
        refuse("zone-model-unknown", fmt::format("there is no zone model file {}", file.string()),
               "a name with a slash or with the ending .so is a file; give its path from the working folder");
    refuse_other_files(file);
    auto model = open(file, before_loading ? before_loading(file) : fs::absolute(file));
    const auto* loaded_one = find(model->name);
    const auto owner = loaded_one ? std::optional(loaded_one->file) : file_of(model->name);
    if (owner && !same_file(*owner, file))
        refuse("zone-model-name-taken",
               fmt::format("the zone model in {} is named '{}', and that name belongs to {}", file.string(),
                           model->name, owner->string()),
               "give the model another name in its descriptor");
    model->tables = tables_;
    models_.push_back(std::move(model));
    return *models_.back();
}

const ZoneModel* ZoneModels::find(std::string_view name) const {
    const std::string keyword = lower_case(name);
    for (const auto& model : models_)
        if (model->name == keyword) return model.get();
    return nullptr;
}

std::optional<fs::path> ZoneModels::file_of(const std::string& keyword) const {
    // A joint model may have the same name and be in the same folder: folders of zone models are searched first.
    const auto find = [&](bool of_zones) -> std::optional<fs::path> {
        for (const auto& folder : path_) {
            const fs::path file = folder / (keyword + library_ending);
            if ((folder.filename() == "zones") == of_zones && is_there(file)) return file;
        }
        return std::nullopt;
    };
    const auto file = find(true);
    return file ? file : find(false);
}

std::vector<std::string> ZoneModels::available() const {
    std::set<std::string> names;
    for (const auto& model : models_) names.insert(model->name);
    for (const auto& folder : path_) {
        if (folder.filename() != "zones") continue; // others hold joint models as well
        std::error_code unreadable;
        for (const auto& entry : fs::directory_iterator(folder, unreadable))
            if (entry.path().extension() == library_ending) names.insert(entry.path().stem().string());
    }
    return {names.begin(), names.end()};
}

} // namespace kaya
