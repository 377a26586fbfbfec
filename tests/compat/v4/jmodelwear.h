// A joint model as written for 3DEC 4 and 5: wide texts, Variant, two arguments of setProperty, tables by number.
#ifndef __JMODELWEAR_H
#define __JMODELWEAR_H

#include "jointmodel.h"

namespace jmodels
{
  class JModelWear : public JointModel {
  public:
    JModelWear();
    virtual String        getName() const;
    virtual String        getFullName() const;
    virtual UInt          getMinorVersion() const;
    virtual String        getProperties() const;
    virtual String        getStates() const;
    virtual Variant       getProperty(UInt index) const;
    virtual void          setProperty(UInt index, const Variant &prop);
    virtual JModelWear   *clone() const { return NEWC(JModelWear()); }
    virtual Double        getMaxNormalStiffness() const { return kn_; }
    virtual Double        getMaxShearStiffness() const { return ks_; }
    virtual void          copy(const JointModel *mod);
    virtual void          run(UByte dim, State *s);
    virtual void          initialize(UByte dim, State *s);
    virtual Bool          isSliding(const State &s) const;
    virtual Bool          isBonded(const State &s) const;
  private:
    Double kn_;
    Double ks_;
    Double friction_;
    Double cohesion_;
    Int    table_;      // friction angle against slip
    Bool   wears_;
    void  *itable_;
    Double tan_friction_;
  };
} // namespace jmodels

#endif
