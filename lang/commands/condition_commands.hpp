// The commands of boundary and initial conditions, histories and output as structs.
#pragma once

#include "base/object_kind.hpp"
#include "lang/commands/range.hpp"
#include "lang/interp/value.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace kaya::lang {

// --- boundary and initial conditions --------------------------------------------------------------
/// Components x, y, z of translation and of rotation; none: all.
struct Fix {
    std::array<bool, 6> components{};
    std::vector<Vec3> directions; ///< of translation
    RangePhrase range;
};
struct Free {
    std::array<bool, 6> components{};
    bool directions = false;
    RangePhrase range;
};
/// A velocity, force or moment along a direction of any length.
struct Directed {
    double value = 0;
    Vec3 direction = Vec3::Zero();
};
struct Gravity {
    Vec3 value = Vec3::Zero();
};
/// hist sine f [t] | cosine f [t] | impulse f [t] | table n | @name: the factor of a load or velocity.
struct Wave {
    enum class Form { sine, cosine, impulse } form = Form::sine;
    double frequency = 0, duration = 0; ///< duration 0: no end
};
struct TableValue {
    std::int64_t table = 0;
    std::string name = {}; ///< in place of the number; "": none
};
struct ScriptValue {
    std::string symbol;
}; ///< without @
struct Multiplier {
    std::variant<Wave, TableValue, ScriptValue> function;
    Place place;
};
/// A number at the origin of coordinates and its change with x, y and z.
struct LinearNumber {
    double at_origin = 0;
    Vec3 gradient = Vec3::Zero();
};
struct Boundary {
    std::array<std::optional<double>, 6> velocity; ///< xvel yvel zvel rxvel ryvel rzvel
    std::array<std::optional<double>, 3> load;     ///< xload yload zload, added
    std::array<bool, 6> free{};                    ///< xfree yfree zfree rxfree ryfree rzfree
    std::optional<std::array<double, 6>> stress;   ///< xx yy zz xy xz yz
    std::array<double, 6> x_gradient{}, y_gradient{}, z_gradient{};
    std::optional<Multiplier> multiplier;
    std::array<bool, 5> quiet{};                            ///< xviscous yviscous zviscous nviscous sviscous
    std::array<bool, 3> reaction{};                         ///< xreaction yreaction zreaction
    std::optional<double> normal_velocity;                  ///< nvel
    std::vector<Directed> directed_velocity, directed_load; ///< dvel dload
    RangePhrase range;
    Place place;
};
struct Apply {
    std::array<std::optional<double>, 6> velocity; ///< of whole blocks
    std::array<std::optional<double>, 6> load;     ///< force through the centroid and moment, added
    std::vector<Directed> directed_velocity, directed_load, directed_moment; ///< dvel dload dmoment
    std::optional<Vec3> at; ///< where the forces act; the centroid if not given
    std::optional<Multiplier> multiplier;
    RangePhrase range;
    Place place;
};
struct Initialize {
    std::array<std::optional<double>, 6> velocity;
    std::array<std::optional<double>, 3> displacement;
    std::array<std::optional<LinearNumber>, 6> stress; ///< sxx syy szz sxy sxz syz
    std::optional<LinearNumber> pore_pressure;
    RangePhrase range;
    Place place;
};
/// insitu topography [kx k] [ky k]: stress of the weight above; ratios of horizontal to vertical stress
struct Topography {
    double kx = 1, ky = 1;
};
/// insitu stress sxx syy szz sxy sxz syz [xgrad ..] [ygrad ..] [zgrad ..]
struct InSitu {
    std::optional<std::array<double, 6>> stress;
    std::array<double, 6> x_gradient{}, y_gradient{}, z_gradient{};
    std::optional<Topography> topography;
    std::optional<LinearNumber> pore_pressure;
    RangePhrase range;
    Place place;
};
/// table n x y ... | table n read file | table n clear
struct TableCommand {
    std::int64_t number = 0;
    std::string name; ///< in place of the number; "": none
    std::vector<std::array<double, 2>> points;
    std::string file;
    bool clear = false;
    Place place;
};
/// water table x y z [normal ..] [density d] | water pressure p [gradient ..] | water off
struct WaterCommand {
    enum class Kind { off, table, pressure, ground };
    std::optional<Kind> kind;
    Vec3 origin = Vec3::Zero(), normal = Vec3(0, 0, 1), gradient = Vec3::Zero();
    std::optional<double> density;
    double pressure = 0;
    std::string file; ///< of the ground surface that is the water table
    Place place;
};
struct Reset {
    enum class What { time, histories, displacements, velocities, joint_displacements, energy, damping };
    std::vector<What> what;
};

// --- histories and output --------------------------------------------------------------------------
struct HistoryItem {
    /// A field of the model or of the nearest object. With a name its rate is recorded: the change in the last step divided by the step.
    struct Quantity {
        ObjectKind kind;
        std::string field, rate;
    };
    /// A value of the joint model at the nearest sub-contact.
    struct Own {
        std::string name;
    };
    /// A FISH function or variable; without @.
    struct Script {
        std::string symbol;
    };
    std::variant<Quantity, Own, Script> what;
    Vec3 place = Vec3::Zero();
    Place text;
    std::string name = {}; ///< "": made of the quantity
};
struct HistoryAdd {
    std::vector<HistoryItem> items;
    std::optional<std::int64_t> interval; ///< ncyc
    std::optional<std::int64_t> number;   ///< of the first item, if the deck gives it
    Place place;
};
struct HistoryDelete {
    std::vector<std::int64_t> numbers; ///< none: all
    Place place;
};
struct HistoryLabel {
    std::int64_t number = 0;
    std::string text;
    Place place;
};
struct HistoryWrite {
    std::vector<std::int64_t> numbers;  ///< none and no names: all
    std::optional<std::int64_t> versus; ///< vs m
    std::vector<std::string> names;     ///< of histories, or their numbers as texts
    std::string versus_name;            ///< "": none
    std::string file;                   ///< none: the deck's name with .csv
    Place place;
};
struct VtkWrite {
    std::string file;
};
struct List {
    enum class What {
        blocks,
        quality,
        contacts,
        sub_contacts,
        interfaces,
        reactions,
        gridpoints,
        zones,
        faces,
        properties,
        histories,
        extremes,
        time,
        unbalanced,
        damping,
        information,
        time_step,
        timing,
        energy,
        hash,
        joint_models,
        boundary,
        groups,
        excavated,
        states,
        stresses,
        stability,
        structures,
        joint_sets,
        memory,
        version,
        modes,
        settings,
        tables,
        ranges,
        frequencies,
        symbols
    };
    std::optional<What> what;                                 ///< none: `symbols` only
    std::vector<std::string> symbols;                         ///< print @a @b: without @
    std::optional<std::int64_t> number;                       ///< list hist n, list prop jmat n
    enum class Part { all, blocks, joints } part = Part::all; ///< list prop mat | jmat
    std::vector<std::string> subjects;                        ///< what its columns are about; empty: the usual ones
    RangePhrase range;
};
struct Ignored {
    std::string word, instead;
}; ///< label, ...: read to its end and ignored; `instead`: the command to use in its place
/// plot: has hundreds of forms. It is examined when it runs, so that no word of it stops a deck.
struct Plot {
    struct Item {
        std::string text, folded;            ///< without quotes or @
        bool quoted = false, script = false; ///< a text; @name or [expression]
    };
    std::vector<Item> words;
    std::string range; ///< from the word `range` on, "" without one
    Place place;
};
struct Movie {
    std::vector<Plot::Item> words;
    Place place;
};

} // namespace kaya::lang
