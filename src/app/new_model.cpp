#include "app/new_model.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr ModelTemplate native_templates[] = {
    {"@NAME@.cpp", R"(// @NAME@: springs in both directions and Coulomb's friction. Change it into what you need.
// kaya/jmodel.h is the manual: what each column is, which signs it has, what may be left out.
#include "kaya/jmodel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace {

// Values come to run() in the order of the table; the enum gives them names.
enum { stiffness_normal, stiffness_shear, friction, property_count };

constexpr kaya_jproperty properties[] = {
    // name, other words, unit, help, initial value (NAN: must be given), minimum, maximum, may be left out
    {"stiffness-normal", "jkn kn", "stress/length", "normal stress per closure", NAN, 0, INFINITY, 0},
    {"stiffness-shear", "jks ks", "stress/length", "shear stress per shear displacement", NAN, 0, INFINITY, 0},
    {"friction", "jfriction fric", "angle", "angle of friction", 0, 0, 89, 0},
};
static_assert(std::size(properties) == property_count);

// What is kept of each sub-contact from cycle to cycle; it starts as 0, and is saved.
enum { slip, history_count };

constexpr kaya_jhistory history[] = {{"slip", "length", "shear displacement beyond the limit, added up"}};
static_assert(std::size(history) == history_count);

// Bit 0, bit 1, ... of the column of states.
constexpr const char* state_names = "slip-now slip-past";
constexpr uint32_t slip_now = 1, slip_past = 2;

ptrdiff_t initialise(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        batch->normal_stiffness[i] = batch->properties[stiffness_normal];
        batch->shear_stiffness[i] = batch->properties[stiffness_shear];
    }
    return -1; // all rows are well
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const double kn = p[stiffness_normal], ks = p[stiffness_shear];
    const double tangent = std::tan(p[friction] * 3.14159265358979323846 / 180);
    double *x = batch->shear_force[0], *y = batch->shear_force[1], *z = batch->shear_force[2];
#pragma GCC ivdep
    for (size_t i = 0; i < batch->n; ++i) {
        const double area = batch->area[i];
        // Compression is positive, opening is positive; no tension is carried.
        const double normal = std::max(0.0, batch->normal_force[i] - kn * area * batch->normal_disp_inc[i]);
        // Shear forces oppose shear displacement.
        const double trial_x = x[i] - ks * area * batch->shear_disp_inc[0][i];
        const double trial_y = y[i] - ks * area * batch->shear_disp_inc[1][i];
        const double trial_z = z[i] - ks * area * batch->shear_disp_inc[2][i];
        const double trial = std::sqrt(trial_x * trial_x + trial_y * trial_y + trial_z * trial_z);
        const double limit = std::min(trial, normal * tangent);
        const double scale = limit / std::max(trial, std::numeric_limits<double>::min());
        const double slipped = area > 0 ? (trial - limit) / (ks * area) : 0;

        batch->frictional_work[i] += 0.5 * (trial + limit) * slipped; // closes the account of energy
        batch->normal_force[i] = normal;
        x[i] = trial_x * scale;
        y[i] = trial_y * scale;
        z[i] = trial_z * scale;
        batch->history[slip][i] += slipped;
        batch->state[i] = (batch->state[i] ? slip_past : 0) | (trial > limit ? slip_now : 0);
    }
    return -1;
}

// A sentence when the values cannot work together.
const char* check(const double* p) {
    if (!(p[stiffness_normal] > 0)) return "stiffness-normal (jkn) is 0: give the joint a normal stiffness";
    if (!(p[stiffness_shear] > 0)) return "stiffness-shear (jks) is 0: give the joint a shear stiffness";
    return nullptr;
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

constexpr kaya_jmodel model = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "@NAME@",
    "Springs and Coulomb's friction",
    "0.1",
    properties,
    property_count,
    history,
    history_count,
    state_names,
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &model; }
)"},
    {"@NAME@.md", R"(# @NAME@

Springs in both directions and Coulomb's friction.

## Equations

Normal force of a sub-contact of area A, compression positive, opening u positive; no tension:

    N = max(0, N - kn A du)                                     (1)

Shear force, trial and limit:

    S' = S - ks A ds,   S = S' min(1, N tan(friction) / |S'|)   (2)

## Properties

| name | other words | unit | initial | meaning |
|---|---|---|---|---|
| `stiffness-normal` | `jkn` `kn` | stress/length | must be given | normal stress per closure |
| `stiffness-shear` | `jks` `ks` | stress/length | must be given | shear stress per shear displacement |
| `friction` | `jfriction` `fric` | angle | 0 | angle of friction |

Keeps `slip`. States: `slip-now`, `slip-past`.

## Build and test

    kaya jmodel build @NAME@.cpp
    kaya test-@NAME@.3dd

## Source

Say where the equations come from.
)"},
    {"CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.20)
project(@NAME@ LANGUAGES CXX)
find_package(kaya REQUIRED)
kaya_add_joint_model(@NAME@ @NAME@.cpp)
enable_testing()
add_test(NAME @NAME@
  COMMAND ${KAYA_PROGRAM} --quiet --joints ${CMAKE_CURRENT_BINARY_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/test-@NAME@.3dd)
)"},
};

constexpr ModelTemplate lua_templates[] = {
    {"@NAME@.lua", R"(-- @NAME@: springs in both directions and Coulomb's friction. Change it into what you need.
-- docs/joint-models-in-lua.md is the manual; signs are those of kaya/jmodel.h: compression and opening are positive.

-- One step of one sub-contact: s is the sub-contact, p its properties, h what is kept of it.
local function run(s, p, h)
    -- No tension is carried.
    s.normal_force = math.max(0, s.normal_force - p.stiffness_normal * s.area * s.normal_disp_inc)
    -- Shear forces oppose shear displacement.
    local k = p.stiffness_shear * s.area
    local x = s.shear_force_x - k * s.shear_disp_inc_x
    local y = s.shear_force_y - k * s.shear_disp_inc_y
    local z = s.shear_force_z - k * s.shear_disp_inc_z
    local trial = math.sqrt(x * x + y * y + z * z)
    local limit = math.min(trial, s.normal_force * math.tan(math.rad(p.friction)))
    local scale = trial > 0 and limit / trial or 0
    local slipped = s.area > 0 and (trial - limit) / k or 0
    s.frictional_work = s.frictional_work + 0.5 * (trial + limit) * slipped -- closes the account of energy
    s.shear_force_x, s.shear_force_y, s.shear_force_z = x * scale, y * scale, z * scale
    h.slip = h.slip + slipped
    -- Bit 0 is the first state, bit 1 the second.
    s.state = (s.state ~= 0 and 2 or 0) | (trial > limit and 1 or 0)
end

return {
    name = "@NAME@",
    title = "Springs and Coulomb's friction",
    version = "0.1",
    properties = {
        {"stiffness-normal", "jkn kn", unit = "stress/length", minimum = 0, help = "normal stress per closure"},
        {"stiffness-shear", "jks ks", unit = "stress/length", minimum = 0, help = "shear stress per shear displacement"},
        {"friction", "jfriction fric", unit = "angle", initial = 0, minimum = 0, maximum = 89, help = "angle of friction"},
    },
    history = {{"slip", unit = "length", help = "shear displacement beyond the limit, added up"}},
    states = {"slip-now", "slip-past"},
    run = run,
    -- A sentence when the values cannot work together.
    check = function(p)
        if not (p.jkn > 0) then return "stiffness-normal (jkn) is 0: give the joint a normal stiffness" end
        if not (p.jks > 0) then return "stiffness-shear (jks) is 0: give the joint a shear stiffness" end
    end,
    stiffness = function(p) return p.stiffness_normal, p.stiffness_shear end,
}
)"},
    {"@NAME@.md", R"(# @NAME@

Springs in both directions and Coulomb's friction.

## Equations

Normal force of a sub-contact of area A, compression positive, opening u positive; no tension:

    N = max(0, N - kn A du)                                     (1)

Shear force, trial and limit:

    S' = S - ks A ds,   S = S' min(1, N tan(friction) / |S'|)   (2)

## Properties

| name | other words | unit | initial | meaning |
|---|---|---|---|---|
| `stiffness-normal` | `jkn` `kn` | stress/length | must be given | normal stress per closure |
| `stiffness-shear` | `jks` `ks` | stress/length | must be given | shear stress per shear displacement |
| `friction` | `jfriction` `fric` | angle | 0 | angle of friction |

Keeps `slip`. States: `slip-now`, `slip-past`.

## Test

    kaya --joints . test-@NAME@.3dd

Lua takes some hundred times longer than a native model: when the idea works, `kaya new-jmodel` begins one.

## Source

Say where the equations come from.
)"},
};

constexpr ModelTemplate shared_templates[] = {
    {"@NAME@.3dd", R"(; Direct shear of two blocks with joint model @NAME@: stress against displacement in @NAME@.csv.
poly brick -0.15,0.15 -0.10,0.10 -0.10,0.0
poly brick -0.10,0.10 -0.10,0.10 0.0,0.10
prop mat 1 density 2600
jmodel model @NAME@ jkn 1e10 jks 5e9 jfric 30
fix range z -0.06 -0.04
bound zload -1e4 range z 0.09 0.11 ; on each of four corners
cycle 3000
hist sstr 0 0 0 nstr 0 0 0 xdis 0 0 0.1
bound xvel 0.01 yvel 0 range z 0.04 0.06
cycle 5000
list jmodel
hist write @NAME@.csv
)"},
    {"test-@NAME@.3dd", R"(; A test of joint model @NAME@: it ends with an error when a sub-contact does not do what it should.
call '@NAME@.3dd'
lua
local function near(what, found, expected, tolerance)
    if math.abs(found - expected) > tolerance * math.abs(expected) then
        error(string.format("%s is %.9g, expected %.9g", what, found, expected))
    end
end
local normal, shear = 0.0, 0.0
for c in contacts() do
    for s in c:sub_contacts() do
        near("strength of a sub-contact", s.shear_force, s.normal_force * math.tan(math.rad(30)), 1e-9)
        normal = normal + s.normal_force
        shear = shear + s.shear_force
    end
end
near("normal force", normal, 4e4, 0.01)
near("shear force", shear, 4e4 * math.tan(math.rad(30)), 0.01)
print("@NAME@ is well")
endlua
)"},
};

std::vector<ModelTemplate> join(std::span<const ModelTemplate> own, std::span<const ModelTemplate> shared) {
    std::vector<ModelTemplate> all(own.begin(), own.end());
    all.insert(all.end(), shared.begin(), shared.end());
    return all;
}

std::string filled(std::string text, const std::string& name) {
    constexpr std::string_view mark = "@NAME@";
    for (auto at = text.find(mark); at != text.npos; at = text.find(mark, at + name.size()))
        text.replace(at, mark.size(), name);
    return text;
}

bool can_be_typed(const std::string& name) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    return !name.empty() && name[0] >= 'a' && name[0] <= 'z' && std::all_of(name.begin(), name.end(), allowed);
}

} // namespace

std::vector<fs::path> write_templates(std::span<const ModelTemplate> list, const NewModel& model) {
    const std::string& name = model.name;
    if (!can_be_typed(name))
        throw Diagnostic(fmt::format("'{}' cannot be the name of a model", name),
                         "use lower-case letters, digits, hyphens and underscores, a letter first");
    if (std::ranges::find(model.taken, name) != model.taken.end())
        throw Diagnostic(fmt::format("there is a model named '{}' already", name),
                         fmt::format("two models of one name cannot be loaded: take another, such as my-{}", name));
    const fs::path folder = model.in / name;
    if (fs::exists(folder))
        throw Diagnostic(fmt::format("{} is there already", folder.string()), "give another name, or remove it");
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed)
        throw Diagnostic(fmt::format("the folder {} cannot be made: {}", folder.string(), failed.message()), {},
                         Fault::run);
    std::vector<fs::path> files;
    for (const auto& each : list) {
        files.push_back(folder / filled(each.file, name));
        std::ofstream stream(files.back());
        stream << filled(each.text, name);
        stream.close();
        if (!stream)
            throw Diagnostic(fmt::format("cannot write {}", files.back().string()), {}, Fault::run);
    }
    return files;
}

std::vector<fs::path> write_new_joint_model(const NewModel& model) {
    return write_templates(join(native_templates, shared_templates), model);
}

std::vector<fs::path> write_new_lua_model(const NewModel& model) { return write_templates(join(lua_templates, shared_templates), model); }

} // namespace kaya
