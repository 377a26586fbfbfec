#include "guide/fish_help.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <sstream>

namespace kaya {

namespace {

/// `names` with blanks between them share one text; `*` in `usage` stands for the name.
struct Entry {
    std::string_view names, usage, text;
};

constexpr std::array statements{
    Entry{"def define", "def NAME  or  def NAME(a, b)\n    ...\n    end",
          "a function; what is assigned to NAME is its value"},
    Entry{
        "loop endloop end_loop",
        "loop i (1, n)            also loop i (from, to, step); not run when from is beyond to\n"
        "    loop while x > 0\n    loop for (i = 1, i < 9, i = i + 1)\n    loop foreach b block.list\n    ...\n    endloop",
        "repeats the lines up to endloop; exit loop leaves it, continue starts the next turn"},
    Entry{"foreach while for", "loop foreach b block.list,  loop while x > 0,  loop for (i = 1, i < 9, i = i + 1)",
          "forms of loop: help loop"},
    Entry{"if then else elseif endif end_if",
          "if x > 0 then\n    ...\n    else if x = 0\n    ...\n    else\n    ...\n    endif",
          "then may be left out; a value that is not 0 is true"},
    Entry{
        "case_of caseof case endcase end_case",
        "case_of n\n      ...        runs when no case fits\n    case 1\n      ...\n    case 2\n      ...\n    endcase",
        "runs the case whose number is n"},
    Entry{"section endsection end_section",
          "section\n    ...\n      if x = 0 then\n        exit section\n      endif\n    ...\n    endsection",
          "a part of a function that exit section leaves"},
    Entry{"exit", "exit,  exit loop,  exit section", "leaves the function, the loop or the section"},
    Entry{"continue", "continue", "starts the next turn of the loop"},
    Entry{"return", "return VALUE", "leaves the function and gives its value"},
    Entry{"command endcommand end_command", "command\n      prop mat 1 dens [density]\n    endcommand",
          "commands of the deck inside a function; [expression] is replaced by its value"},
    Entry{"whilestepping while_stepping", "whilestepping",
          "the function that it stands in runs after every cycle; see also: help fish callback"},
    Entry{"array", "array a(n)  or  array a(n, m) b(k)",
          "makes arrays filled with 0; one of just these sizes is kept as it is"},
    Entry{"local global argument", "local a = 1,  local a, b,  local array a(3),  global a = 1,  argument a, b",
          "where a name holds; a local holds in the whole function"},
    Entry{"null", "null", "does nothing"},
};

constexpr std::array functions{
    Entry{"abs acos asin atan cos sin tan exp ln log sqrt sgn round", "*(x)",
          "of a number; angles in radians, log to the base 10, ln to the base e"},
    Entry{"atan2", "*(y, x)", "angle of a direction, in radians"},
    Entry{"max min", "*(a, b, ...)", "largest or least of numbers"},
    Entry{"int", "*(x)", "cut to a whole number; of a text, the number in it"},
    Entry{"float", "*(x)", "as a real number; of a text, the number in it"},
    Entry{"pi degrad", "*", "pi, and pi/180"},
    Entry{"urand", "*", "random number from 0 to 1, the same in every run of a deck"},
    Entry{"grand", "*", "random number of mean 0 and deviation 1, the same in every run of a deck"},
    Entry{"and or lshift rshift", "*(a, n)", "on the bits of whole numbers"},
    Entry{"not", "*(a)", "on the bits of a whole number; in a condition: a is 0"},
    Entry{"vector", "*(x, y, z)", "a vector"},
    Entry{"xcomp ycomp zcomp", "*(v)", "component of a vector; can be set"},
    Entry{"dot cross", "*(a, b)", "product of vectors"},
    Entry{"mag mag2 unit", "*(v)", "length of a vector, its square, the vector of length 1"},
    Entry{"dipfromnorm ddfromnorm", "*(v)", "dip and dip direction of a plane from its normal, in degrees"},
    Entry{"normfromdipdd", "*(dip, dd)", "normal of a plane from dip and dip direction in degrees"},
    Entry{"string", "*(x), *(x, width, fill, digits)", "a value as a text; a pointer as the number of its object"},
    Entry{"strlen tolower toupper", "*(t)", "of a text"},
    Entry{"substr", "*(t, first, count)", "part of a text; the first letter is 1"},
    Entry{"index", "*(t, part)", "where a text stands in another, 0 when nowhere"},
    Entry{"char", "*(n)", "the letter of a code"},
    Entry{"parse pre_parse", "*(t, i)", "the i-th word of a text; parse gives a number if it is one"},
    Entry{"buildstr", "*('%1 of %2', a, b)", "puts values into a text"},
    Entry{"code_name", "*", "kaya"},
    Entry{"type", "*(x)", "1 integer, 2 real, 3 text, 4 pointer, 5 array, 6 vector"},
    Entry{"array_dim array_size", "*(a), array_size(a, i)", "number of dimensions of an array, size of one of them"},
    Entry{"get_array", "*(n, m)", "makes an array"},
    Entry{"lose_array", "*(a)", "does nothing: arrays go by themselves"},
    Entry{"table", "*(n, x)", "value of table n at x, between its points on a line; table(n, x) = y adds a point"},
    Entry{"xtable ytable vtable", "*(n, i)", "abscissa, ordinate, both of the i-th point of table n; can be set"},
    Entry{"history_size history_min history_max history_last", "*(h)",
          "of the samples of a history, by its number or label: how many, least, greatest, last"},
    Entry{"history_value history_time", "*(h, i)", "i-th sample of a history, and its time"},
    Entry{"stop_reason", "*", "why the last cycle or solve came to its end, as a text"},
    Entry{"command_output", "*(t)", "runs the command in the text and gives what it prints, which is not shown"},
    Entry{"table_size table_id", "*(n)", "number of points of table n; its number, 0 when there is none"},
    Entry{"table_name", "*(n)", "name of table n; can be set"},
    Entry{"get_table", "*('name')", "number of the table of that name, 0 when there is none"},
    Entry{"del_table", "*(n)", "removes table n"},
    Entry{"find_range", "*('left')", "the name again, 0 when there is no such range"},
    Entry{"in_range", "*('left', p)", "1 when the object p, or a place as a vector, is in the named range"},
    Entry{"inbox", "*(a, b, v)", "1 when the place v lies in the box of the corners a and b"},
    Entry{"open", "*(name, mode, 1)", "opens a file: mode 0 to read, 1 to write, 2 to append; 0 when that went well"},
    Entry{"read write", "*(a, n)", "n lines of the open file into or from the array a"},
    Entry{"close", "*", "closes the file"},
    Entry{"out notify", "*(x)", "prints a line"},
    Entry{"error", "error = 'text'", "stops everything with this text"},
    Entry{"clock", "*", "1/100 s since the program began"},
    Entry{"b_next c_next cx_next gp_next z_next face_next vl_next", "*(p)",
          "next object of the list that p stands in, null at its end"},
    Entry{"b_near c_near cx_near gp_near z_near face_near", "*(x, y, z), *(v)", "nearest object to a place"},
    Entry{"b_extra c_extra cx_extra gp_extra z_extra face_extra", "*(p), *(p, i)",
          "a value of your own that the object keeps; can be set"},
    Entry{"b_ispare b_rspare c_ispare c_rspare cx_ispare cx_rspare gp_ispare gp_rspare z_ispare z_rspare", "*(p, i)",
          "a value of your own that the object keeps; can be set"},
    Entry{"c_link1 c_link2", "*(c)", "next contact that has the first (second) block of c, null at the end"},
    Entry{"c_prop j_prop", "*(c, 'jkn')", "property of the joint model of a contact, 0 when it was not given"},
    Entry{"cx_prop", "*(p, 'jkn'), *(p, 'slip')",
          "property of the joint model, or what the model remembers of the sub-contact, which can be set"},
    Entry{"j_model", "*(c)", "name of the joint model of a contact or sub-contact"},
    Entry{"z_prop", "*(z, 'bulk')", "property of the material of a zone"},
    Entry{"z_gp", "*(z, i)", "corner of a zone, i from 1 to 4"},
    Entry{"face_gp", "*(f, i)", "gridpoint on a face, i from 1 to face_ngp(f)"},
    Entry{"face_vlist", "*(f)", "first of the corners of a face, for vl_next"},
    Entry{"m_density m_bulk m_shear m_jkn m_jks m_jfriction m_jcohesion m_jtension m_jdilation m_bfriction m_bcohesion "
          "m_btension m_bdilation m_cohesion m_friction m_tension m_dilation m_phi m_psi",
          "*(n)", "what 'prop' gave to material n; can be set, as by the command prop"},
    Entry{"table.create", "*('name'), *(n)", "makes a table and gives its number"},
    Entry{"list", "*(1, 'a', v)", "makes a list; x('end') = v appends to it, x('start') = v puts before it"},
    Entry{"map", "*('a', 1, 'b', 2)", "makes a map of keys and values; m('a') reads and sets one"},
    Entry{"tensor", "*(xx, yy, zz, xy, xz, yz)", "makes a symmetric tensor; t->xx reads and sets a component"},
    Entry{"list.sequence list.seq", "*(a, b, ...)", "a list of its arguments, as list(a, b, ...)"},
    Entry{"list.create", "*(n, value)", "a list of n equal values, 0 if none is given"},
    Entry{"list.append list.prepend", "*(l, a, b)", "a new list with values behind or before those of l"},
    Entry{"list.concatenate list.extend", "*(l, m)", "a new list of the elements of both"},
    Entry{"list.insert", "*(l, i, value)", "a new list with the value at place i"},
    Entry{"list.remove list.at", "*(l, i)", "a new list without the i-th element; the i-th element"},
    Entry{"list.range", "*(l, first, last)", "a new list of a part, as l(first, last)"},
    Entry{"list.resize", "*(l, n, value)", "a new list with n elements, cut or filled"},
    Entry{"list.find.index list.count", "*(l, value)",
          "place of the first equal element, 0 if none; number of equal ones"},
    Entry{"list.size list.sum list.max list.min list.reverse list.sort", "*(l)", "of a list"},
    Entry{"map.keys map.size", "*(m)", "a list of the keys, in order; their number"},
    Entry{"map.has", "*(m, key)", "1 if the map has the key"},
    Entry{"map.value", "*(m, key, otherwise)", "the value of a key"},
    Entry{"map.add", "*(m, key, value)", "a new map with one more pair"},
    Entry{"map.remove", "*(m, key)", "a new map without the key"},
    Entry{"map.merge", "*(m, n)", "a new map of the pairs of both; those of n count"},
    Entry{"array.copy", "*(a)", "a new array with the same elements"},
    Entry{"tensor.trace tensor.i2 tensor.j2", "*(t)", "invariants of a tensor"},
    Entry{"tensor.prin", "*(t)", "the principal values of a tensor as a vector, the most negative first"},
    Entry{"tensor.prin.dir", "*(t)", "the matrix whose columns are the directions of the principal values"},
    Entry{"tensor.prin.from", "*(v, m)",
          "the tensor with the principal values v in the directions of the columns of m"},
    Entry{"matrix.rows matrix.cols", "*(m)", "the numbers of rows and of columns of a matrix"},
    Entry{"matrix.det matrix.inverse matrix.transpose", "*(m)", "determinant, inverse and transpose of a matrix"},
    Entry{"matrix.identity", "*(n)", "the unit matrix with n rows"},
    Entry{"string.find", "*(t, part, from)", "where a text stands in another, 0 if nowhere"},
    Entry{"string.compare", "*(t, u)", "-1, 0 or 1: t is before, equal to, behind u"},
    Entry{"string.replace", "*(t, part, by)", "the text with every part replaced"},
    Entry{"string.simplify", "*(t)", "the text with one blank where it has several, and none at its ends"},
    Entry{"string.split", "*(t, between)", "a list of the parts of a text"},
    Entry{"string.join", "*(l, between)", "one text of the elements of a list"},
    Entry{"type.name", "*(x)", "int, float, string, vector, pointer, array, list, map, tensor or structure"},
    Entry{"math.ceiling math.floor math.cosh math.sinh math.tanh math.isnan math.isinf", "*(x)", "of a number"},
    Entry{"math.outer.product", "*(v, v)", "the tensor of a vector with itself; of two vectors a matrix"},
    Entry{
        "mech.solve", "*('ratio-local')",
        "present value of a limit: ratio-average, ratio-maximum, ratio-local, unbalanced-maximum, time-total, cycles-total"},
    Entry{"system.command", "*('...')", "runs a program; only with kaya --trust"},
    Entry{"block.isrigid", "*(b)", "1 if the block is rigid"},
    Entry{"block.contactlist", "*(b)", "list of the contacts in which a block takes part"},
    Entry{"block.subcontact.sratio", "*(p)", "shear force over normal force"},
    Entry{"block.face.bface", "*(f)", "the face itself: faces of contacts are faces of blocks"},
    Entry{"block.face.gplist", "*(f)", "list of the gridpoints on a face"},
    Entry{"block.zone.stress", "*(z)", "stress as a tensor; can be set"},
    Entry{"block.find block.contact.find block.subcontact.find block.gp.find block.zone.find block.face.find", "*(n)",
          "the object of that number, null if there is none"},
    Entry{"block.num block.contact.num block.subcontact.num block.gp.num block.zone.num block.face.num", "*",
          "number of objects"},
    Entry{"block.maxid block.contact.maxid block.subcontact.maxid block.gp.maxid block.zone.maxid block.face.maxid",
          "*", "greatest number of an object"},
    Entry{"block.head block.contact.head block.subcontact.head block.gp.head block.zone.head block.face.head", "*",
          "first object, null if there is none"},
    Entry{"block.isgroup block.contact.isgroup block.subcontact.isgroup block.gp.isgroup block.zone.isgroup "
          "block.face.isgroup",
          "*(p, 'name')", "1 if the object is in the group, whatever the case of its letters"},
    Entry{"block.list block.contact.list block.subcontact.list block.gp.list block.zone.list block.face.list", "*",
          "list of pointers to all objects of the kind, for loop foreach"},
    Entry{"block.contact.subcontactlist", "*(c)", "list of pointers to the sub-contacts of a contact"},
    Entry{"block.gplist block.zonelist block.facelist", "*(b)", "list of pointers to the parts of a block"},
};

template <std::size_t Size>
std::string find(const std::array<Entry, Size>& entries, std::string_view name, std::string_view kind) {
    for (const auto& entry : entries) {
        std::istringstream names{std::string(entry.names)};
        for (std::string one; names >> one;) {
            if (one != name) continue;
            std::string usage(entry.usage);
            for (auto at = usage.find('*'); at != usage.npos; at = usage.find('*')) usage.replace(at, 1, name);
            return fmt::format("{}\n    {}\n    {}\n", kind, usage, entry.text);
        }
    }
    return {};
}

} // namespace

std::string about_fish(std::string_view name) {
    const std::string text = find(statements, name, "FISH statement");
    return text.empty() ? find(functions, name, "FISH function") : text;
}

} // namespace kaya
