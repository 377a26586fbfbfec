// list modes: what works on rigid blocks and on zones, in small and large strain, in static and dynamic runs. The test app.modes tries
// each cell, and compares the table with docs/modes.md.
#include "commands/list/listing.hpp"
#include "commands/program/text_table.hpp"

#include <array>
#include <string_view>

namespace kaya {

namespace {

constexpr std::array modes{"rigid", "zones", "small", "large", "static", "dynamic"};

struct ModeRow {
    std::string_view what;
    /// One letter for each mode: works (y), is an error (e), or has no meaning (-).
    std::string_view cells = "yyyyyy";
};

// clang-format off
constexpr ModeRow rows[] = {
    {"gravity"},
    {"fix"},
    {"fix rotation", "yeyyyy"},
    {"fix direction"},
    {"free"},
    {"bound xvel"},
    {"bound rxvel", "yeyyyy"},
    {"bound dvel"},
    {"bound nvel", "eyyyyy"},
    {"bound xvel hist"},
    {"bound xload"},
    {"bound dload"},
    {"bound xload hist"},
    {"bound stress"},
    {"bound xreaction"},
    {"bound xviscous", "eyyyyy"},
    {"bound nviscous", "eyyyyy"},
    {"bound sviscous", "eyyyyy"},
    {"apply xvel"},
    {"apply rxvel", "yeyyyy"},
    {"apply xload", "yeyyyy"},
    {"apply xmoment", "yeyyyy"},
    {"initialize xvel"},
    {"initialize rxvel", "yeyyyy"},
    {"initialize xdis"},
    {"initialize sxx", "eyyyyy"},
    {"initialize pp"},
    {"insitu stress"},
    {"insitu topography"},
    {"insitu pp"},
    {"water table"},
    {"water pressure"},
    {"damp local"},
    {"damp combined"},
    {"damp global"},
    {"damp rayleigh"},
    {"damp contact"},
    {"mscale on", "yyyyye"},
    {"mscale partial"},
    {"jmodel elastic"},
    {"jmodel mohr"},
    {"jmodel bilinear-mohr"},
    {"jmodel softening-mohr"},
    {"jmodel fracture-energy"},
    {"jmodel nonlinear"},
    {"jmodel power"},
    {"jmodel barton-bandis"},
    {"jmodel continuously-yielding"},
    {"jmodel velocity-weakening"},
    {"zone model elastic", "eyyyyy"},
    {"zone model mohr-coulomb", "eyyyyy"},
    {"zone model strain-softening", "eyyyyy"},
    {"zone model drucker-prager", "eyyyyy"},
    {"zone model hoek-brown", "eyyyyy"},
    {"zone model ubiquitous-joint", "eyyyyy"},
    {"zone model anisotropic-elastic", "eyyyyy"},
    {"zone nmd", "-yyyyy"},
    {"join"},
    {"join, unlike meshes", "-yyyyy"},
    {"facetri", "yeyyyy"},
    {"structure cable"},
    {"structure cable, sbond"},
    {"structure cable, fbond", "eyyyyy"},
    {"structure beam"},
    {"structure beam anchor"},
    {"structure beam clamp", "yeyyyy"},
    {"structure beam, kn ks"},
    {"structure beam, cohesion"},
    {"structure liner"},
    {"structure liner anchor"},
    {"structure liner clamp", "yeyyyy"},
    {"structure liner, kn ks"},
    {"structure liner, cohesion"},
    {"excavate, fill"},
    {"solve elastic"},
    {"solve fos joints"},
    {"solve fos zones", "eyyyyy"},
    {"solve control gravity"},
    {"solve control scale, load"},
    {"solve control scale, velocity"},
    {"list stability"},
    {"limit equilibrium"},
};
// clang-format on

std::string_view word_of(char cell) {
    switch (cell) {
    case 'y': return "yes";
    case 'e': return "error";
    default: return "-";
    }
}

} // namespace

std::string list_modes(Session&, const lang::List&) {
    std::vector<std::string> headings{"what"};
    headings.insert(headings.end(), modes.begin(), modes.end());
    TextTable table(std::move(headings));
    for (const ModeRow& row : rows) {
        std::vector<std::string> words{std::string(row.what)};
        for (const char cell : row.cells) words.emplace_back(word_of(cell));
        table.add(std::move(words));
    }
    return table.text();
}

} // namespace kaya
