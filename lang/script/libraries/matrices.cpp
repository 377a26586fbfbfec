#include "lang/script/libraries/matrices.hpp"

#include "lang/script/state/guard.hpp"

#include <Eigen/Dense>
#include <array>

namespace kaya::script {

namespace {

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double number_in(lua_State* L, Eigen::Index at) {
    lua_rawgeti(L, 1, at + 1);
    const double number = lua_tonumber(L, -1);
    lua_pop(L, 1);
    return number;
}

Square square_at(lua_State* L) {
    const auto size = static_cast<Eigen::Index>(lua_tointeger(L, 2));
    Square square(size, size);
    for (Eigen::Index i = 0; i < square.size(); ++i) square.data()[i] = number_in(L, i);
    return square;
}

int determinant(lua_State* L) {
    lua_pushnumber(L, square_at(L).determinant());
    return 1;
}

int inverse(lua_State* L) {
    const Square square = square_at(L);
    const Eigen::FullPivLU<Square> factors(square);
    if (!square.allFinite() || !factors.isInvertible())
        throw Diagnostic("the matrix has no inverse: its rows are not independent of each other", {}, Fault::run);
    const Square result = factors.inverse();
    lua_createtable(L, static_cast<int>(result.size()), 0);
    for (Eigen::Index i = 0; i < result.size(); ++i) {
        lua_pushnumber(L, result.data()[i]);
        lua_rawseti(L, -2, i + 1);
    }
    return 1;
}

/// Twelve numbers: the principal values, the least first, and their unit vectors as the columns of a matrix, row by row.
int principal(lua_State* L) {
    std::array<double, 6> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = number_in(L, static_cast<Eigen::Index>(i));
    Eigen::Matrix3d matrix;
    matrix << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
    if (!matrix.allFinite()) throw Diagnostic("the tensor has a component that is not a number", {}, Fault::run);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> found(matrix);
    for (int i = 0; i < 3; ++i) lua_pushnumber(L, found.eigenvalues()[i]);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) lua_pushnumber(L, found.eigenvectors()(i, k));
    return 12;
}

constexpr std::array<luaL_Reg, 4> functions{{{"determinant", guarded<determinant>},
                                             {"inverse", guarded<inverse>},
                                             {"principal", guarded<principal>},
                                             {nullptr, nullptr}}};

} // namespace

void add_matrix_functions(lua_State* L) { luaL_setfuncs(L, functions.data(), 0); }

} // namespace kaya::script
