// Shared by the zone models that ship: moduli, the elastic step, and rows of a batch.
#pragma once

#include "kaya/law/rows.hpp"
#include "kaya/zmodel.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace kaya::zones {

/// Six components in the order of kaya/zmodel.h: xx, yy, zz, xy, xz, yz.
using Tensor = std::array<double, 6>;

constexpr double radians = 0.017453292519943295; ///< of a degree

/// Unit normal of a plane, upward: dip below the horizontal, dip direction clockwise from y; degrees.
inline std::array<double, 3> plane_normal(double dip, double dip_direction) {
    const double d = dip * radians, dd = dip_direction * radians;
    return {std::sin(d) * std::sin(dd), std::sin(d) * std::cos(dd), std::cos(d)};
}

/// Isotropic elasticity.
struct Moduli {
    double bulk, shear;

    double lame() const { return bulk - 2.0 / 3.0 * shear; }
    /// stress += lambda trace(strain) 1 + 2 G strain
    void add(Tensor& stress, const Tensor& strain) const {
        const double two_shear = 2 * shear, volume = lame() * (strain[0] + strain[1] + strain[2]);
        for (int k = 0; k < 6; ++k) stress[k] += two_shear * strain[k];
        for (int k = 0; k < 3; ++k) stress[k] += volume;
    }
};

/// The first properties of every isotropic zone model.
inline constexpr std::size_t moduli_count = 2;
inline constexpr kaya_zproperty bulk_property{"bulk", "k",      "stress", "bulk modulus",   NAN,
                                              0,      INFINITY, 0,        KAYA_ZREDUCE_NONE};
inline constexpr kaya_zproperty shear_property{"shear", "g",      "stress", "shear modulus",  NAN,
                                               0,       INFINITY, 0,        KAYA_ZREDUCE_NONE};

inline void give_moduli(const double* properties, double* bulk, double* shear) {
    *bulk = properties[0];
    *shear = properties[1];
}

/// The elastic step of a whole batch.
inline void add_elastic(kaya_zbatch& batch, const Moduli& moduli) {
    const double two_shear = 2 * moduli.shear, lame = moduli.lame();
    double *sxx = batch.stress[0], *syy = batch.stress[1], *szz = batch.stress[2], *sxy = batch.stress[3],
           *sxz = batch.stress[4], *syz = batch.stress[5];
    const double *xx = batch.strain_inc[0], *yy = batch.strain_inc[1], *zz = batch.strain_inc[2],
                 *xy = batch.strain_inc[3], *xz = batch.strain_inc[4], *yz = batch.strain_inc[5];
    const std::size_t n = batch.n;
    KAYA_INDEPENDENT_ROWS
    for (std::size_t i = 0; i < n; ++i) {
        const double mean = lame * (xx[i] + yy[i] + zz[i]);
        sxx[i] = (sxx[i] + two_shear * xx[i]) + mean;
        syy[i] = (syy[i] + two_shear * yy[i]) + mean;
        szz[i] = (szz[i] + two_shear * zz[i]) + mean;
        sxy[i] += two_shear * xy[i];
        sxz[i] += two_shear * xz[i];
        syz[i] += two_shear * yz[i];
    }
}

inline Tensor stress_of(const kaya_zbatch& batch, std::size_t i) {
    Tensor t;
    for (int k = 0; k < 6; ++k) t[k] = batch.stress[k][i];
    return t;
}

inline Tensor strain_of(const kaya_zbatch& batch, std::size_t i) {
    Tensor t;
    for (int k = 0; k < 6; ++k) t[k] = batch.strain_inc[k][i];
    return t;
}

inline void put_stress(const kaya_zbatch& batch, std::size_t i, const Tensor& t) {
    for (int k = 0; k < 6; ++k) batch.stress[k][i] = t[k];
}

/// The descriptor of a model from its tables.
template <std::size_t Properties, std::size_t History>
constexpr kaya_zmodel model(const char* name, const char* title,
                            const std::array<kaya_zproperty, Properties>& properties,
                            const std::array<kaya_jhistory, History>& history, const char* states, bool flows,
                            ptrdiff_t (*run)(kaya_zbatch*), const char* (*check)(const double*) = nullptr,
                            void (*moduli)(const double*, double*, double*) = give_moduli) {
    return {KAYA_ZMODEL_INTERFACE,
            sizeof(kaya_zmodel),
            name,
            title,
            "1.0",
            properties.data(),
            Properties,
            history.data(),
            History,
            states,
            flows ? 1u : 0u,
            run,
            check,
            moduli};
}

} // namespace kaya::zones
