/* SPDX-License-Identifier: MIT */
/* The base class of joint models written for 3DEC 4, 5, 7 or 9, so that their sources compile unchanged.
 * docs/joint-models-from-3dec.md says how; new models are better written against kaya/jmodel.h.
 *
 * Where sources differ in a const, the base has both forms, and the one that is not const calls the
 * other: whichever a source overrides is the one that is used. */
#ifndef KAYA_COMPAT_JOINTMODEL_H
#define KAYA_COMPAT_JOINTMODEL_H

#include "kaya/compat/state.h"

namespace jmodels {

class JointModel {
public:
    JointModel() = default;
    JointModel(const JointModel&) = default;
    JointModel& operator=(const JointModel&) = default;
    virtual ~JointModel() = default;

    virtual String getName() const = 0; /* the keyword of `jmodel` */
    virtual String getFullName() const = 0;
    virtual String getProperties() const = 0;          /* commas between properties, blanks between their synonyms */
    virtual String getStates() const = 0;              /* commas between names */
    virtual Variant getProperty(UInt index) const = 0; /* from 1 */
    virtual JointModel* clone() const = 0;
    virtual Double getMaxNormalStiffness() const = 0; /* stress/length; asked after each step */
    virtual Double getMaxShearStiffness() const = 0;

    virtual String getPluginName() const { return getName(); }
    virtual UInt getMinorVersion() const { return 0; }
    virtual void destroy() { delete this; }

    /* Sources of 3DEC 4 and 5 override the first, later ones the second; the engine calls the second. It has
     * no default value, which would make JointModel::setProperty(i, p) ambiguous. */
    virtual void setProperty(UInt, const Variant&) { valid_ = 0; }
    virtual void setProperty(UInt index, const Variant& value, UInt /*restoreVersion*/) { setProperty(index, value); }

    virtual void copy(const JointModel* other) {
        valid_ = 0;
        can_fail_ = other->can_fail_;
    }
    virtual void run(UByte dim, State* state) {
        if (!isValid(dim)) initialize(dim, state);
    }
    virtual void initialize(UByte dim, State*) { valid_ = dim; }

    /* What the properties do not show and must outlive a save file. */
    virtual void save(std::ostream&) const {}
    virtual void restore(std::istream&, UInt /*version*/) {}

    virtual bool isSliding(const State&) const { return false; }
    virtual bool isSliding(const State& state) { return static_cast<const JointModel*>(this)->isSliding(state); }
    virtual bool isBonded(const State&) const { return false; }
    virtual bool isBonded(const State& state) { return static_cast<const JointModel*>(this)->isBonded(state); }

    virtual bool supportsPropertyScaling() const { return false; }
    virtual bool supportsPropertyScaling() { return static_cast<const JointModel*>(this)->supportsPropertyScaling(); }
    virtual void scaleProperties(const Double&, const std::vector<UInt>&) {}

    virtual bool supportsStressStrengthRatio() const { return false; }
    virtual Double getStressStrengthRatio(const State&) const { return 0; }
    virtual bool supportsStrengthStressRatio() const { return false; }
    virtual Double getStrengthStressRatio(const State&) const { return 0; }

    /* Energies: a list of names with commas, numbers from 1. */
    virtual String getEnergies() const { return String(); }
    virtual String getEnergies() { return static_cast<const JointModel*>(this)->getEnergies(); }
    virtual Double getEnergy(UInt) const { return 0; }
    virtual Double getEnergy(UInt index) { return static_cast<const JointModel*>(this)->getEnergy(index); }
    virtual bool getEnergyAccumulate(UInt) const { return false; }
    virtual bool getEnergyAccumulate(UInt index) {
        return static_cast<const JointModel*>(this)->getEnergyAccumulate(index);
    }
    virtual void setEnergy(UInt, const Double&) {}
    virtual void activateEnergy() {}
    virtual bool getEnergyActivated() const { return false; }
    virtual bool getEnergyActivated() { return static_cast<const JointModel*>(this)->getEnergyActivated(); }

    bool isValid(UByte dim) const { return valid_ == dim; }
    void setValid(UByte dim) { valid_ = dim; }
    bool canFail() const { return can_fail_; }
    void setIfCanFail(bool can) { can_fail_ = can; }
    bool getPlugIn() const { return plug_in_; }
    void setPlugIn(bool is) { plug_in_ = is; }

    static UInt getMajorVersion() { return 9; }
    static UInt getLibraryMinorVersion() { return 0; }

private:
    UByte valid_ = 0;
    bool can_fail_ = true;
    bool plug_in_ = true;
};

} // namespace jmodels

#endif
