#include "jmodelwear.h"
#include "state.h"
#include "version.txt"

#ifdef WEAR_EXPORTS
int __stdcall DllMain(void *,unsigned, void *)
{
  return 1;
}

extern "C" __declspec(dllexport) const char *getName()
{
#ifdef JMODELDEBUG
  return "jmodelweard";
#else
  return "jmodelwear";
#endif
}

extern "C" __declspec(dllexport) unsigned getMajorVersion()
{
  return MAJOR_VERSION;
}

extern "C" __declspec(dllexport) unsigned getMinorVersion()
{
  return MINOR_VERSION;
}

extern "C" __declspec(dllexport) void *createInstance()
{
  jmodels::JModelWear *m = NEWC(jmodels::JModelWear());
  return (void *)m;
}
#endif // WEAR_EXPORTS

namespace jmodels
{
#include <cmath>

  static const Double d2d = 3.14159265358979323846 / 180.0;
  static const UInt slip_now     = 0x01;
  static const UInt tension_now  = 0x02;
  static const UInt slip_past    = 0x04;
  static const UInt tension_past = 0x08;

  JModelWear::JModelWear()
    : kn_(0.0), ks_(0.0), friction_(0.0), cohesion_(0.0), table_(0), wears_(false), itable_(0), tan_friction_(0.0) {}

  String JModelWear::getName() const { return L"Wear"; }
  String JModelWear::getFullName() const { return L"Joint " "that wears"; }
  UInt JModelWear::getMinorVersion() const { return MINOR_VERSION; }

  String JModelWear::getProperties() const
  {
    return L"jkn kn         ,"
           L"jks ks, jfriction   friction, jcohesion,"
           L"weartable , wears";
  }

  String JModelWear::getStates() const
  {
    return L"slip-n,tension-n,slip-p,tension-p";
  }

  Variant JModelWear::getProperty(UInt index) const
  {
    switch (index) {
    case 1: return kn_;
    case 2: return ks_;
    case 3: return friction_;
    case 4: return cohesion_;
    case 5: return table_;
    case 6: return wears_;
    }
    return 0.0;
  }

  void JModelWear::setProperty(UInt index, const Variant &prop)
  {
    JointModel::setProperty(index, prop);
    switch (index) {
    case 1: kn_       = prop.toDouble(); break;
    case 2: ks_       = prop.toDouble(); break;
    case 3: friction_ = prop.toDouble(); break;
    case 4: cohesion_ = prop.toDouble(); break;
    case 5: table_    = prop.toInt(); break;
    case 6: wears_    = prop.toBool(); break;
    }
  }

  void JModelWear::copy(const JointModel *m)
  {
    JointModel::copy(m);
    const JModelWear *em = dynamic_cast<const JModelWear *>(m);
    if (!em) throw std::exception("internal error: copy from another class");
    kn_ = em->kn_;
    ks_ = em->ks_;
    friction_ = em->friction_;
    cohesion_ = em->cohesion_;
    table_ = em->table_;
    wears_ = em->wears_;
  }

  void JModelWear::initialize(UByte dim, State *s)
  {
    JointModel::initialize(dim, s);
    tan_friction_ = tan(friction_ * d2d);
    itable_ = 0;
    if (wears_) {
      itable_ = s->getTableIndexFromID(table_);
      if (!itable_) throw std::exception("the wear table is not there");
    }
  }

  void JModelWear::run(UByte dim, State *s)
  {
    JointModel::run(dim, s);
    if (s->state_ & slip_now) s->state_ |= slip_past;
    s->state_ &= ~slip_now;
    if (s->state_ & tension_now) s->state_ |= tension_past;
    s->state_ &= ~tension_now;

    s->normal_force_inc_ = -kn_ * s->area_ * s->normal_disp_inc_;
    s->normal_force_ += s->normal_force_inc_;
    if (s->normal_force_ <= 0.0) {
      s->normal_force_ = 0.0;
      s->shear_force_ = DVect3(0, 0, 0);
      s->state_ |= tension_now;
      s->iworking_[0] += 1;
      return;
    }
    s->shear_force_inc_ = s->shear_disp_inc_ * (-ks_ * s->area_);
    s->shear_force_ += s->shear_force_inc_;
    Double tphi = tan_friction_;
    if (itable_ && wears_) tphi = tan(s->getYFromX(itable_, s->working_[0]) * d2d);
    Double fsm = s->shear_force_.mag();
    Double fsmax = cohesion_ * s->area_ + s->normal_force_ * tphi;
    if (fsm > fsmax) {
      s->working_[0] += (fsm - fsmax) / (ks_ * s->area_);   // slip so far
      s->shear_force_ *= fsmax / fsm;
      s->state_ |= slip_now;
    }
  }

  Bool JModelWear::isSliding(const State &s) const { return (s.state_ & slip_now) != 0; }
  Bool JModelWear::isBonded(const State &s) const { return cohesion_ > 0.0 && !(s.state_ & (slip_past | tension_past)); }

} // namespace jmodels
