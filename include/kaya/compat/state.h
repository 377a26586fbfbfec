/* SPDX-License-Identifier: MIT */
/* Input of a joint model about a sub-contact, and its output.
 *
 * Opening is positive in normal_disp_, compression in normal_force_; forces are forces, not stresses;
 * shear vectors are in global axes and lie in the plane of the contact. normal_disp_ and shear_disp_ are
 * those at the start of the step; compiled with KAYA_COMPAT_DISPLACEMENT_AT_END they include the increments of
 * this step. The engine takes normal_force_, shear_force_, state_ and what the model keeps; the other
 * outputs are there for the model itself. */
#ifndef KAYA_COMPAT_STATE_H
#define KAYA_COMPAT_STATE_H

#include "kaya/compat/property.h"
#include "kaya/jmodel.h"

namespace jmodels {

struct State {
    enum { max_working_ = 10, max_iworking_ = 2 };

    UInt state_ = 0;  /* bit i belongs to the i-th name of getStates() */
    Double area_ = 0; /* may be 0 */
    Double normal_force_ = 0;
    DVect3 shear_force_;
    Double normal_disp_ = 0;
    DVect3 shear_disp_;
    Double normal_disp_inc_ = 0;
    DVect3 shear_disp_inc_;
    Double normal_force_inc_ = 0; /* out */
    DVect3 shear_force_inc_;      /* out */
    Double dnop_ = 0;             /* out: part of the normal increment at which the joint opened; starts as all of it */
    Double working_[max_working_] = {}; /* kept from call to call, and saved */
    Int iworking_[max_iworking_] = {};

    Double getTimeStep() const { return time_step_; }
    bool isThermal() const { return false; }
    bool isCreep() const { return false; }
    bool isFluid() const { return fluid_; } /* whether there is water in this joint; forces are effective */
    bool trackEnergy() const { return true; }

    /* NULL when there is no such table. Not to be saved: ask again in initialize(). */
    void* getTableIndexFromID(const String& name) const {
        return tables_ ? const_cast<void*>(tables_->find(tables_, name.c_str())) : nullptr;
    }
    void* getTableIndexFromID(Int number) const { return getTableIndexFromID(String(std::to_string(number))); }
    Double getYFromX(void* table, const Double& x) const { return usable(table)->value(table, x); }
    Double getSlopeFromX(void* table, const Double& x) const { return usable(table)->slope(table, x); }

    /* Set by the adapter. */
    Double time_step_ = 0;
    bool fluid_ = false;
    const kaya_jtables* tables_ = nullptr;

private:
    const kaya_jtables* usable(const void* table) const {
        if (!tables_ || !table) throw std::runtime_error("it reads a table that is not there");
        return tables_;
    }
};

} // namespace jmodels

#endif
