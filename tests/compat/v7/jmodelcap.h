// A joint model as written for 3DEC 7: paths of the headers, restoreVersion with a default, tables by name, a cap
// in compression, hidden members that only save() knows.
#pragma once

#include "jmodels/src/jointmodel.h"

namespace jmodels {
    class JModelCap : public JointModel {
    public:
        JModelCap();
        virtual String        getName() const;
        virtual String        getFullName() const;
        virtual String        getPluginName() const { return getName(); }
        virtual UInt          getMinorVersion() const;
        virtual String        getProperties() const;
        virtual String        getStates() const;
        virtual Variant       getProperty(UInt index) const;
        virtual void          setProperty(UInt index, const Variant &prop, UInt restoreVersion = 0);
        virtual JModelCap    *clone() const { return NEW("JModelCap") JModelCap(); }
        virtual Double        getMaxNormalStiffness() const { return kn_; }
        virtual Double        getMaxShearStiffness() const { return ks_; }
        virtual void          copy(const JointModel *mod);
        virtual void          run(UByte dim, State *s);
        virtual void          initialize(UByte dim, State *s);
        virtual void          save(std::ostream &o) const;
        virtual void          restore(std::istream &i, UInt version);
        virtual Double        getStressStrengthRatio(const Double &, const DVect3 &) const { return 10.0; }
        virtual bool          supportsStressStrengthRatio() const { return true; }
        virtual bool          supportsPropertyScaling() const { return true; }
        virtual void          scaleProperties(const Double &scale, const std::vector<UInt> &props);
    private:
        Double kn_;
        Double ks_;
        Double friction_;
        Double tension_;
        Double cap_;
        String table_;        // factor of the cap against crushed closure
        DVect3 pull_;         // a constant traction, for the vector property
        UInt   steps_;
        void  *iCap_;
        Double res_friction_; // follows friction_
        Double crushed_;      // hidden: no property shows it
    };
}
