#ifndef __JMODELMEMORY_H
#define __JMODELMEMORY_H
// A joint model in the style of 3DEC 7: header and source, an exported class, members in a separate struct, its state
// written to the save file as bytes.
#ifndef __JOINTMODEL_H
#include "jmodels/src/jointmodel.h"
#endif

namespace jmodels {
    class JMODEL_EXPORT JModelMemory : public JointModel {
    public:
        enum class Mode : UByte { loose, tight };
        JModelMemory();
        JModelMemory(const JModelMemory &other) { copy(&other); }
        virtual ~JModelMemory();
        virtual String        getName() const;
        virtual String        getPluginName() const { return getName(); }
        virtual String        getFullName() const;
        virtual UInt          getMinorVersion() const;
        virtual String        getProperties() const;
        virtual String        getStates() const;
        virtual Variant       getProperty(UInt index) const;
        virtual void          setProperty(UInt index, const Variant &prop, UInt restoreVersion = 0);
        virtual JModelMemory *clone() const { return NEWC(JModelMemory()); }
        virtual Double        getMaxNormalStiffness() const { return material_.kn; }
        virtual Double        getMaxShearStiffness() const { return material_.ks; }
        virtual void          copy(const JointModel *mod);
        virtual void          run(UByte dim, State *s);
        virtual void          initialize(UByte dim, State *s);
        virtual void          save(std::ostream &o) const;
        virtual void          restore(std::istream &i, UInt version);
        virtual bool          isSliding(const State &s) const { return s.state_ & 1; }
        virtual bool          isBonded(const State &) const { return false; }
        virtual Double        getStressStrengthRatio(const Double &, const DVect3 &) const { return 10.0; }
        virtual bool          supportsStressStrengthRatio() const { return true; }
        virtual bool          supportsPropertyScaling() const { return true; }
        virtual void          scaleProperties(const Double &scale, const std::vector<UInt> &props);
    private:
        struct Material { Double kn = 0, ks = 0, friction = 0; };
        Material              material_;
        Mode                  mode_ = Mode::loose;
        std::vector<DVect3>   turns_;       // shear forces at which it turned back
        Double               *last_ = nullptr;
        String                label_ = L"none";
    };
}
#endif
