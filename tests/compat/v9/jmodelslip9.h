// A joint model as written for 3DEC 9: narrow texts, base::Property, the block of energies. It is the twin of
// tests/compat/slip-native.cpp and slip-lua.lua, which must give the same curve.
#pragma once

#include "jointmodel.h"

namespace jmodels {
    class JModelSlip9 : public JointModel {
    public:
        JModelSlip9();
        string        getName() const override;
        string        getFullName() const override;
        string        getPluginName() const override { return getName(); }
        uint32        getMinorVersion() const override;
        string        getProperties() const override;
        string        getStates() const override;
        base::Property getProperty(uint32 index) const override;
        void          setProperty(uint32 index, const base::Property &prop, uint32 restoreVersion = 0) override;
        JModelSlip9  *clone() const override { return NEWC(JModelSlip9()); }
        double        getMaxNormalStiffness() const override { return kn_; }
        double        getMaxShearStiffness() const override { return ks_; }
        void          copy(const JointModel *mod) override;
        void          run(uint32 dim, State *s) override;
        void          initialize(uint32 dim, State *s) override;
        void          destroy() override { delete this; }
        bool          isSliding(const State &s) const override { return (s.state_ & 1) != 0; }
        bool          isBonded(const State &s) const override { return s.state_ == 0; }
        double        getStrengthStressRatio(const double &, const DVect3 &) const { return 10.0; }
        bool          supportsStrengthStressRatio() const override { return true; }
        bool          supportsPropertyScaling() const override { return true; }
        void          scaleProperties(const double &scale, const std::vector<uint32> &props) override;
        string        getEnergies() const override { return "energy-slip , energy-strain"; }
        double        getEnergy(uint32 i) const override;
        bool          getEnergyAccumulate(uint32 i) const override;
        void          setEnergy(uint32 i, const double &d) override;
        void          activateEnergy() override { if (energies_ == nullptr) energies_ = NEWC(Energies()); }
        bool          getEnergyActivated() const override { return energies_ != nullptr; }
        ~JModelSlip9() { delete energies_; }
        JModelSlip9(const JModelSlip9 &) = delete;
    private:
        struct Energies { double slip_ = 0, strain_ = 0; };
        Energies *energies_ = nullptr;
        double kn_, ks_, friction_, res_friction_, cohesion_, tension_, dilation_;
        bool   report_;
        string note_;
        double tan_friction_, tan_res_friction_, tan_dilation_;
    };
}
