// Zone models that the program has loaded, by keyword. They are found in the folders of joint models, and in the folder `zones` next to
// each one that is called `joints`.
#pragma once

#include "laws/law_table.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace kaya {

/// The moduli with which a zone resists, stress, at the greatest.
struct ZoneModuli {
    double bulk, shear;
};

/// Why a batch failed.
struct ZoneFailure {
    std::size_t row;
    std::string message;
    bool trespass = false; ///< it wrote where it must not
};

/// A zone model after loading: the descriptor, checked once, with its texts copied.
class ZoneModel : public LawTable {
public:
    /// `library` keeps the descriptor loaded. Throws Diagnostic that names the invalid entry of the table.
    ZoneModel(const kaya_zmodel* descriptor, std::filesystem::path file, std::shared_ptr<void> library);

    /// Whether volume strain and the plastic change of the mean stress are averaged over neighbours.
    bool flows() const { return descriptor_.flows != 0; }
    bool keeps_anything() const { return !states.empty() || !history.empty(); }

    /// The reason why the values are invalid, or empty.
    std::string check(const std::vector<double>& values) const;

    /// Throws Diagnostic when the model throws, or gives a modulus that is not finite and above 0.
    ZoneModuli moduli(const std::vector<double>& values) const;

    /// One step of the rows of a batch. Exceptions of the model, results that are not finite and changes of its properties are failures
    /// too. For the report of a crash: `first` is the number of the first zone, with `numbers` of each; without numbers the report has
    /// rows.
    std::optional<ZoneFailure> run(kaya_zbatch& batch, std::int32_t first = 0,
                                   const std::int32_t* numbers = nullptr) const;

    const kaya_jtables* tables = nullptr; ///< of the deck; NULL where there is none

private:
    kaya_zmodel descriptor_;
    std::shared_ptr<void> library_;
};

/// Folders of joint models, and after each one that is called `joints` the folder `zones` next to it.
std::vector<std::filesystem::path> with_zone_folders(const std::vector<std::filesystem::path>& folders);

/// Finds, loads and stores zone models. An explicit list: nothing registers itself.
class ZoneModels {
public:
    void set_path(const std::vector<std::filesystem::path>& folders) { path_ = with_zone_folders(folders); }
    void set_tables(const kaya_jtables* tables) { tables_ = tables; }

    /// Is called with each file before anything of it runs, and returns the name by which the file is to be opened. Throws Diagnostic to refuse it.
    std::function<std::filesystem::path(const std::filesystem::path&)> before_loading;

    /// The model with that keyword; loads it if necessary. A name with a slash or with the ending .so is a file. Throws Diagnostic: not
    /// found (with the available names and a suggestion), not a zone model, other interface version, invalid table, name taken.
    const ZoneModel& get(std::string_view name);

    const ZoneModel* find(std::string_view name) const; ///< among the loaded ones
    std::vector<std::string> available() const;         ///< loaded or in the folders, sorted
    const std::vector<std::unique_ptr<ZoneModel>>& loaded() const { return models_; }

private:
    const ZoneModel& load(const std::filesystem::path& file);
    std::optional<std::filesystem::path> file_of(const std::string& keyword) const;

    std::vector<std::filesystem::path> path_;
    const kaya_jtables* tables_ = nullptr;
    std::vector<std::unique_ptr<ZoneModel>> models_;
};

} // namespace kaya
