// Joint models that the program has loaded, by keyword.
#pragma once

#include "laws/joint_object.hpp"
#include "laws/joint_tables.hpp"
#include "laws/law_table.hpp"
#include "laws/zone_model.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Functions of a joint model. For a library they are those of its descriptor; a model from another source (a script) has its own. They
/// correspond to the members of kaya_jmodel.
struct JointFunctions {
    std::function<ptrdiff_t(kaya_jbatch*)> initialise, run;
    std::function<std::string(const double*)> check; ///< may be empty
    std::function<void(const double*, double*, double*)> max_stiffness;
};

/// A joint model after loading: the descriptor, checked once, with its texts copied.
class JointModel : public LawTable {
public:
    /// The table of a loaded library, checked and copied; `library` keeps it loaded. Throws Diagnostic that names the invalid entry of the
    /// table.
    JointModel(const kaya_jmodel* descriptor, std::filesystem::path file, std::shared_ptr<void> library);

    /// A model whose functions are not in the descriptor; `owner` owns the descriptor and the functions.
    JointModel(const kaya_jmodel* descriptor, std::filesystem::path file, std::shared_ptr<void> owner,
               JointFunctions functions);

    /// A number of each sub-contact that is set from outside.
    struct Field {
        std::string name, unit, help;
        double initial;
        std::optional<std::size_t> property; ///< whose value is used until it is set
    };
    std::vector<Field> fields;
    std::optional<std::size_t> find_field(std::string_view word) const;
    bool needs_place() const { return (descriptor_.needs & KAYA_JMODEL_NEEDS_PLACE) != 0; }

    std::vector<std::size_t> vectors; ///< first of three history variables that are a vector in the plane

    /// The reason why the values are invalid, or empty.
    std::string check(const std::vector<double>& values) const;

    /// Whether it stores an object per sub-contact: then a batch needs the column of objects.
    bool keeps_objects() const { return descriptor_.restore != nullptr; }

    /// An object's value of a property; nullopt when the model has none. Throws Diagnostic when the model throws.
    std::optional<double> object_value(const JointObject& object, std::size_t property) const;
    /// Sets a property of an object; false when the object does not accept it.
    bool set_object_value(JointObject& object, std::size_t property, double value) const;

    /// Whether it reports the properties that its objects hold.
    bool shows_objects() const { return keeps_objects() && descriptor_.object_value != nullptr; }

    /// The object that gave these bytes. Throws Diagnostic (Fault::run) when the model cannot make it.
    JointObject restore_object(const std::vector<double>& values, std::string_view bytes) const;

    /// The tables of the deck, for batches; NULL where there is none.
    const kaya_jtables* tables = nullptr;

    const kaya_jmodel& descriptor() const { return descriptor_; }
    const JointFunctions& functions() const { return functions_; }

private:
    void find_vectors();
    void read_fields();

    kaya_jmodel descriptor_;
    std::shared_ptr<void> library_; ///< keeps it loaded
    JointFunctions functions_;
};

/// Finds, loads and stores joint models. An explicit list: nothing registers itself.
class JointRegistry {
public:
    /// Folders that are searched for `NAME.so`; the first match is used.
    void set_path(std::vector<std::filesystem::path> folders) {
        path_ = std::move(folders);
        zones.set_path(path_);
        zones.set_tables(tables_->interface());
    }

    /// Zone models, from the same folders and those next to them.
    ZoneModels zones;

    /// Makes the model of a file that is not a library. Throws Diagnostic.
    using Maker = std::function<std::unique_ptr<JointModel>(const std::filesystem::path&)>;

    /// Files with that ending (".lua") are made into models by `maker`.
    void add_loader(const std::string& ending, Maker maker) { makers_[ending] = std::move(maker); }

    /// Is called with each file before anything of it runs, and returns the name by which the file is to be opened. Throws Diagnostic to refuse it.
    std::function<std::filesystem::path(const std::filesystem::path&)> before_loading;

    /// The model with that keyword; loads it if necessary. Libraries named as in 3DEC, libjmodelslip009.so, are opened to read their
    /// keyword. A name with a slash or with the ending .so, or with the ending of another known kind of file, is a file. Throws Diagnostic:
    /// not found (with the available names and a suggestion), not a joint model, other interface version (both numbers), invalid table,
    /// name taken.
    const JointModel& get(std::string_view name);

    /// The keyword of a model that 3DEC calls otherwise (cyjm), in lower case; else the word itself.
    static std::string keyword_of(std::string_view word);

    const JointModel* find(std::string_view name) const; ///< among the loaded ones
    std::vector<std::string> available() const;          ///< loaded or in the folders, sorted
    const std::vector<std::unique_ptr<JointModel>>& loaded() const { return models_; }

    /// Whether a loaded model was given by the path of its file, and cannot be found by its name alone.
    bool is_by_path(const JointModel& model) const;

    /// The tables of the deck for loaded models.
    JointTables& tables() { return *tables_; }

private:
    bool is_file_name(std::string_view name) const;
    std::vector<std::string> endings() const;
    std::filesystem::path file_named(const std::filesystem::path& name) const;
    std::optional<std::filesystem::path> file_of(const std::string& keyword) const;
    std::unique_ptr<JointModel> open(const std::filesystem::path& file) const;
    const JointModel* find_among_3dec(const std::string& keyword);
    const JointModel& load(const std::filesystem::path& file);

    std::vector<std::filesystem::path> path_;
    std::map<std::string, Maker> makers_; ///< by ending
    std::unique_ptr<JointTables> tables_ = std::make_unique<JointTables>();
    std::vector<std::unique_ptr<JointModel>> models_;
};

} // namespace kaya
