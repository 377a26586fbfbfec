#include "app/tools.hpp"

#include "app/command_line.hpp"
#include "app/run_report.hpp"

#include "commands/session/save_session.hpp"
#include "io/field_csv.hpp"
#include "io/history_csv.hpp"
#include "laws/joint_model.hpp"
#include "report/report.hpp"
#include "report/scene_data.hpp"
#include "lang/modern/language.hpp"
#include "lang/interp/format.hpp"
#include "lang/modern/convert.hpp"
#include "system/door.hpp"
#include "system/whole_file.hpp"

#include <fmt/format.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

/// Calls `work(path, source, name)` for each deck; mistakes are shown. Returns the exit status.
template <class Work> int for_each_deck(const std::vector<std::string>& decks, Output& output, Work work) {
    int status = 0;
    for (const auto& deck : decks) {
        try {
            const fs::path path = lang::find_deck(deck, {"."});
            if (!work(path, lang::read_source(path, deck), deck)) status = static_cast<int>(Fault::deck);
        } catch (const lang::DeckErrors& errors) {
            for (const auto& error : errors.all) output.message(error);
            status = static_cast<int>(Fault::deck);
        } catch (const Diagnostic& error) {
            output.message(error);
            status = static_cast<int>(error.fault);
        }
    }
    return status;
}

} // namespace

int format_decks(const std::vector<std::string>& decks, Formatting what, Output& output) {
    return for_each_deck(decks, output, [&](const fs::path& path, const lang::Source& source, const std::string& deck) {
        const std::string text = lang::format_deck(lang::language(), source);
        if (what == Formatting::write) write_whole_file(path.string(), text);
        else if (what == Formatting::show) output.print_deck(text);
        else if (file_text(path) != text) {
            output.print(fmt::format("{} is not in its long form", deck));
            return false;
        }
        return true;
    });
}

int convert_decks(const std::vector<std::string>& decks, const std::string& to, bool write, Output& output) {
    return for_each_deck(decks, output, [&](const fs::path& path, const lang::Source& source, const std::string&) {
        const auto converted = lang::convert_deck(source, to == "modern" ? lang::To::modern : lang::To::classic);
        for (const auto& note : converted.kept) output.message(note);
        if (write) write_whole_file(path.string(), converted.text);
        else output.print_deck(converted.text);
        return true;
    });
}

std::string write_report(const std::vector<std::string>& saved, const std::string& page,
                         const std::vector<fs::path>& joint_folders) {
    ReportOrder order;
    order.source = "saved model";
    order.version = program_version();
    JointRegistry joints;
    joints.set_path(joint_folders);
    order.law_names = law_names_of(joints);
    // The last one is the model of the tables; the earlier ones are its history.
    Model model;
    SaveExtras extras;
    std::string file;
    for (std::size_t i = 0; i < saved.size(); ++i) {
        file = find_saved(saved[i]);
        extras = restore_state(model, file);
        if (i == 0) order.centre = report_centre(model);
        if (i + 1 < saved.size()) order.before.push_back(report_state(model, order.centre));
    }
    order.file = fs::path(file).filename().string();
    std::string name = page;
    if (name.empty()) {
        name = file.ends_with(save_ending) ? file.substr(0, file.size() - save_ending.size()) : file;
        name += ".html";
    }
    write_whole_file(name, report_of(model, extras, order));
    return name;
}

std::vector<std::string> export_saved(const std::string& saved, const std::string& folder, bool paraview) {
    const std::string file = find_saved(saved);
    Model model;
    const SaveExtras extras = restore_state(model, file);
    const std::string bare = file.ends_with(save_ending) ? file.substr(0, file.size() - save_ending.size()) : file;
    const fs::path into = folder.empty() ? fs::path(bare + "-tables") : fs::path(folder);
    if (const auto problem = door::make_folders(into, Use::write))
        throw Diagnostic(fmt::format("cannot make the folder {}: {}", into.string(), problem.message()),
                         "give another: --into FOLDER", Fault::run);
    const Units units = units_of(extras);
    std::vector<std::string> written;
    const auto write = [&](const std::string& name, const std::string& text) {
        written.push_back((into / name).string());
        write_whole_file(written.back(), text);
    };
    for (const ObjectKind kind : exported_kinds())
        write(fmt::format("{}.csv", info_of(kind).file), field_csv(model, kind, units));
    write("fields.csv", field_list_csv(units));
    if (!model.histories.all.empty()) write("histories.csv", history_csv(model.histories, {}, {}, units));
    for (std::size_t i = 0; i < extras.decks.size(); ++i)
        write(fmt::format("deck-{}-{}", i + 1, fs::path(extras.decks[i].name).filename().string()),
              extras.decks[i].content);
    if (!paraview) return written;
    const auto files = VtkSeries().write(model, (into / fs::path(bare).filename()).string());
    written.insert(written.end(), files.begin(), files.end());
    return written;
}

} // namespace kaya
