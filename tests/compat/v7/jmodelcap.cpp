#include "jmodelcap.h"
#include "jmodels/src/state.h"
#include "version.txt"
#include <algorithm>
#include <limits>

#ifdef EXAMPLE_EXPORTS
int __stdcall DllMain(void *,unsigned, void *) { return 1; }
extern "C" EXPORT_TAG const char *getName() { return "jmodelcap"; }
extern "C" EXPORT_TAG unsigned getMajorVersion() { return MAJOR_VERSION; }
extern "C" EXPORT_TAG unsigned getMinorVersion() { return UPDATE_VERSION; }
extern "C" EXPORT_TAG void *createInstance() { jmodels::JModelCap *m = new jmodels::JModelCap(); return (void *)m; }
#endif

namespace jmodels {
    static const Double dDegRad = 3.14159265358979323846 / 180.0;
    static const UInt slip_now     = 0x01;
    static const UInt tension_now  = 0x02;
    static const UInt slip_past    = 0x04;
    static const UInt tension_past = 0x08;
    static const UInt cap_now      = 0x10;
    static const UInt cap_past     = 0x20;

    JModelCap::JModelCap() : kn_(0), ks_(0), friction_(0), tension_(0), cap_(1e20), table_("0"), pull_(0, 0, 0), steps_(0),
                             iCap_(nullptr), res_friction_(0), crushed_(0) {}

    String JModelCap::getName() const { return L"masonry_cap"; }
    String JModelCap::getFullName() const { return L"Coulomb with a cap"; }
    UInt JModelCap::getMinorVersion() const { return UPDATE_VERSION; }
    String JModelCap::getProperties() const {
        return L"stiffness-normal           kn jkn,"
               L"stiffness-shear            ks jks,"
               L"friction                   fric  ,"
               L"tension                          ,"
               L"strength_cap                     ,"
               L"table_cap                        ,"
               L"pull                             ,"
               L"steps, friction_residual";
    }
    String JModelCap::getStates() const { return L"slip-n, tension-n, slip-p, tension-p, cap-n , cap-p "; }

    Variant JModelCap::getProperty(UInt index) const {
        switch (index) {
        case 1: return(kn_);
        case 2: return(ks_);
        case 3: return(friction_);
        case 4: return(tension_);
        case 5: return(cap_);
        case 6: return(table_);
        case 7: return(pull_);
        case 8: return(steps_);
        case 9: return(res_friction_);
        }
        return(0.0);
    }

    void JModelCap::setProperty(UInt index, const Variant &prop, UInt restoreVersion) {
        JointModel::setProperty(index, prop, restoreVersion);
        switch (index) {
        case 1: kn_ = prop.toDouble(); break;
        case 2: ks_ = prop.toDouble(); break;
        case 3: friction_ = prop.toDouble(); if (!restoreVersion) res_friction_ = friction_; break;
        case 4: tension_ = prop.toDouble(); break;
        case 5: cap_ = prop.toDouble(); break;
        case 6: table_ = prop.toString(); break;
        case 7: pull_ = prop.to<DVect3>(); break;
        case 8: steps_ = prop.to<UInt>(); break;
        case 9: res_friction_ = prop.toDouble(); break;
        }
    }

    void JModelCap::copy(const JointModel *m) {
        JointModel::copy(m);
        const JModelCap *mm = dynamic_cast<const JModelCap *>(m);
        if (!mm) throw std::runtime_error("Internal error: constitutive model dynamic cast failed.");
        kn_ = mm->kn_; ks_ = mm->ks_; friction_ = mm->friction_; tension_ = mm->tension_; cap_ = mm->cap_;
        table_ = mm->table_; pull_ = mm->pull_; steps_ = mm->steps_; res_friction_ = mm->res_friction_;
    }

    void JModelCap::scaleProperties(const Double &scale, const std::vector<UInt> &props) {
        for (UInt u = 0; u < props.size(); ++u)
            if (props[u] == 4) tension_ *= scale;
        setValid(0);
    }

    void JModelCap::initialize(UByte dim, State *s) {
        JointModel::initialize(dim, s);
        iCap_ = nullptr;
        if (table_ != "0" && table_ != "") {
            iCap_ = s->getTableIndexFromID(table_);
            if (!iCap_) throw std::runtime_error("no table named " + table_ + " for the cap");
        }
        if (kn_ <= 0.0) throw std::runtime_error("stiffness-normal is missing");
    }

    void JModelCap::run(UByte dim, State *s) {
        JointModel::run(dim, s);
        if (s->isThermal() || s->isCreep()) throw std::runtime_error("not for that");
        steps_++;
        if (s->area_ <= 0.0) return;
        if (s->state_ & slip_now) s->state_ |= slip_past;
        if (s->state_ & tension_now) s->state_ |= tension_past;
        if (s->state_ & cap_now) s->state_ |= cap_past;
        s->state_ &= ~(slip_now | tension_now | cap_now);

        Double fn_old = s->normal_force_;
        s->normal_force_inc_ = -kn_ * s->area_ * s->normal_disp_inc_;
        s->normal_force_ += s->normal_force_inc_;
        Double ften = s->state_ & tension_past ? 0.0 : -tension_ * s->area_;
        if (s->normal_force_ <= ften) {
            s->dnop_ = (s->normal_force_inc_ == 0.0) ? 0.0 : s->normal_disp_inc_ * (ften - fn_old) / s->normal_force_inc_;
            s->normal_force_ = 0.0;
            s->shear_force_ = DVect3(0, 0, 0);
            s->normal_force_inc_ = 0;
            s->shear_force_inc_ = DVect3(0, 0, 0);
            s->state_ |= tension_now;
            s->working_[State::max_working_ - 1] = s->dnop_;
            return;
        }
        Double limit = cap_ * s->area_;
        if (iCap_) limit *= s->getYFromX(iCap_, crushed_);
        if (s->normal_force_ > limit) {
            crushed_ += (s->normal_force_ - limit) / (kn_ * s->area_);
            s->normal_force_ = limit;
            s->state_ |= cap_now;
            if (iCap_) s->working_[1] = s->getSlopeFromX(iCap_, crushed_);
        }
        s->shear_force_inc_ = s->shear_disp_inc_ * -(ks_ * s->area_);
        s->shear_force_ += s->shear_force_inc_;
        s->shear_force_ += pull_ * s->area_;
        Double phi = s->state_ & slip_past ? res_friction_ : friction_;
        Double fsmax = std::max(0.0, s->normal_force_ * std::tan(phi * dDegRad));
        Double fsm = s->shear_force_.mag();
        if (fsm > fsmax) {
            Double ratio = fsm > std::numeric_limits<Double>::epsilon() ? fsmax / fsm : 0.0;
            s->shear_force_ *= ratio;
            s->state_ |= slip_now;
            s->iworking_[1]++;
        }
        if (s->normal_force_ != s->normal_force_) throw std::runtime_error(String(L"not a number in ") + L"masonry_cap");
    }

    void JModelCap::save(std::ostream &o) const { o.write((const char *)&crushed_, sizeof(crushed_)); }
    void JModelCap::restore(std::istream &i, UInt version) {
        if (version > UPDATE_VERSION) throw std::runtime_error("saved by a later version");
        i.read((char *)&crushed_, sizeof(crushed_));
    }
}
