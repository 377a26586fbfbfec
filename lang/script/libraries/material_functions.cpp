// Properties that `prop` gave to a material number: m_density(n), m_jkn(n) = 1e9.
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

struct MaterialName {
    const char* name;
    const char* word; ///< of the command prop
};

constexpr std::array<MaterialName, 19> names{{{"m_density", "density"},
                                              {"m_bulk", "bulk"},
                                              {"m_shear", "shear"},
                                              {"m_jkn", "jkn"},
                                              {"m_jks", "jks"},
                                              {"m_jcohesion", "jcohesion"},
                                              {"m_jfriction", "jfriction"},
                                              {"m_jtension", "jtension"},
                                              {"m_jdilation", "jdilation"},
                                              {"m_cohesion", "bcohesion"},
                                              {"m_friction", "bfriction"},
                                              {"m_tension", "btension"},
                                              {"m_dilation", "bdilation"},
                                              {"m_phi", "bfriction"},
                                              {"m_psi", "bdilation"},
                                              {"m_bcohesion", "bcohesion"},
                                              {"m_bfriction", "bfriction"},
                                              {"m_btension", "btension"},
                                              {"m_bdilation", "bdilation"}}};

const MaterialName& name_of(lua_State* L) {
    return names[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))];
}

std::int64_t number_of(lua_State* L) {
    const std::int64_t number = integer_argument(L, 1, name_of(L).name);
    if (number < 1 || number > 2147483647)
        throw Diagnostic(fmt::format("'{}' is given {}; materials have numbers from 1 up", name_of(L).name, number), {},
                         Fault::run);
    return number;
}

int read_material(lua_State* L) {
    push_fish_value(L, world_of(L).property(World::Material{number_of(L)}, name_of(L).word));
    return 1;
}

int write_material(lua_State* L) {
    const double value = number_argument(L, 2, name_of(L).name);
    const std::int64_t number = number_of(L);
    if (!is_restoring(L)) world_of(L).set_property(World::Material{number}, name_of(L).word, value);
    return 0;
}

} // namespace

void add_materials(lua_State* L) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        lua_pushinteger(L, static_cast<lua_Integer>(i));
        lua_pushcclosure(L, guarded<read_material>, 1);
        add_reader(L, names[i].name, 1, 1);
        lua_pushinteger(L, static_cast<lua_Integer>(i));
        lua_pushcclosure(L, guarded<write_material>, 1);
        add_writer(L, names[i].name);
    }
}

} // namespace kaya::script
