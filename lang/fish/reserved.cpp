#include "lang/fish/reserved.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace kaya::fish {

namespace {

/// Names with the same reason, with blanks between.
struct Group {
    bool planned;
    std::string_view names;
    std::string_view instead;
};

constexpr Group groups[] = {
    {true, "gp_temp", "heat is not supported"},
    {true, "z_fsi z_fsr z_fri z_frr z_total_strain", "z_vsi, z_ssi, z_vsr, z_ssr are the strains and their rates"},
    {true, "z_sig from_principal principal_stress b_moitensor",
     "z_sxx and so on, z_sig1 to z_sig3, b_xmoi to b_zmoi are the components"},
    {true, "apply_head bou_head bou_new gp_bou", "use the command bound, and gp_xload for loads"},
    {true, "cx_edge1 cx_edge2", "there are no pointers to edges"},
    {true, "fc_arg", "the function is called without an argument"},
    {true, "water_table_head", "use the command water"},
    {false, "atol btol ctol dtol etol", "tolerances follow from the size of the blocks"},
    {false, "ftime ftdel flow_head flowrate flowvel fluid_density c_flowplane face_flow gp_fk z_perm z_poros",
     "flow of fluids is not supported"},
    {false, "crtdel crtime", "creep is not supported"},
    {false, "thdt thtime", "heat is not supported"},
    {false, "cable_head liner_head beam_head knot_head knot_near", "structures have no FISH names: read them in Lua"},
    {false, "imem fmem xmem mem get_mem lose_mem", "use an array"},
    {false, "b_inside", "use b_near and compare coordinates"},
    {false, "b_face2 b_wall", "blocks have one list of faces, and none is a wall"},
    {false, "c_obj_type c_fid c_cid cx_fid face_fracid face_sreg r_head",
     "there are no fracture sets; c_jset and face_jset are the numbers of joint sets"},
    {false, "face_zone z_geo_metric z_sonplane", "a face has many zones; walk b_zone and z_next"},
    {false, "sopen sread swrite sclose", "a deck cannot speak with other programs"},
    {false, "input msgbox environment sleep", "a run does not ask and does not wait; use set @name = value"},
    {false, "output realtime normfromdip code_majorversion", "use out, clock, normfromdipdd, code_name"},
    {false, "cable_* liner_* le_* beam_* knot_*", "structures have no FISH names: read them in Lua"},
    {false, "fk_* fp_* fpx_* fpz_*", "flow of fluids is not supported"},
    {false, "cf_*", "config has no such option"},
    {false, "zfd_*", "use z_near and the fields of the zone"},
    {true, "bou_*", "use the command bound"},
    {true, "matrix.lubksb matrix.ludcmp", "use matrix.inverse(m) * b"},
    {true, "matrix.from.axis.angle matrix.from.euler matrix.to.axis.angle matrix.to.euler tensor.total",
     "their conventions are not published: write the matrix out, matrix(list(list(...), ...))"},
    {true, "string.csv.* list.insert.list", "use string.split, string.join, list.insert"},
    {true, "fracture.* dfn.*", "FISH does not know fractures: use the commands fracture list and fracture compute"},
    {true, "geom.*", "use the commands import and cut"},
    {true, "struct.*", "read structures in Lua"},
    {false, "flowknot.* flowplane.* fluid.*", "flow of fluids is not supported"},
    {false, "thermal.* creep.*", "neither heat nor creep is supported"},
    {false, "socket.* dialog.* io.in io.dialog.*", "a run does not ask and does not speak with other programs"},
    {false, "memory.*", "use an array or a list"},
    {false, "ball.* clump.* wall.* zone.* gp.*", "this is of another program; here: block.*, block.zone.*, block.gp.*"},
};

std::vector<ReservedName> all_names() {
    std::vector<ReservedName> names;
    for (const auto& group : groups)
        for (std::string_view rest = group.names; !rest.empty();) {
            const auto end = std::min(rest.find(' '), rest.size());
            names.push_back({rest.substr(0, end), group.planned, group.instead});
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    return names;
}

} // namespace

std::span<const ReservedName> reserved_names() {
    static const std::vector<ReservedName> names = all_names();
    return names;
}

const ReservedName* find_reserved(std::string_view name) {
    const auto names = reserved_names();
    const auto found = std::ranges::find(names, name, &ReservedName::name);
    return found == names.end() ? nullptr : &*found;
}

const ReservedName* find_reserved_family(std::string_view name) {
    if (const auto* exact = find_reserved(name)) return exact;
    const auto names = reserved_names();
    const auto found = std::ranges::find_if(names, [name](const ReservedName& reserved) {
        const std::string_view family = reserved.name;
        return family.back() == '*' && name.starts_with(family.substr(0, family.size() - 1));
    });
    return found == names.end() ? nullptr : &*found;
}

Diagnostic reserved_message(std::string_view name, const ReservedName& reserved) {
    Diagnostic diagnostic(
        fmt::format("'{}' of 3DEC is not {}", name, reserved.planned ? "supported yet" : "supported by kaya"),
        std::string(reserved.instead));
    diagnostic.code = "unsupported-fish-name";
    return diagnostic;
}

} // namespace kaya::fish
