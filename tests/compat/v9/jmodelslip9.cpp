#include "jmodelslip9.h"
#include "state.h"
#include "version.txt"

#ifdef EXAMPLE_LIB
int __stdcall DllMain(void *,unsigned, void *) { return 1; }
#endif

extern "C" EXPORT_TAG const char *getName() { return "jmodelslip9"; }
extern "C" EXPORT_TAG unsigned getMajorVersion() { return MAJOR_VERSION; }
extern "C" EXPORT_TAG unsigned getMinorVersion() { return UPDATE_VERSION; }
extern "C" EXPORT_TAG void *createInstance() { jmodels::JModelSlip9 *m = NEWC(jmodels::JModelSlip9()); return (void *)m; }

namespace jmodels {
    static const double dDegRad = 3.14159265358979323846 / 180.0;
    static const uint32 slip_now     = 0x01;
    static const uint32 tension_now  = 0x02;
    static const uint32 slip_past    = 0x04;
    static const uint32 tension_past = 0x08;

    JModelSlip9::JModelSlip9() : kn_(0), ks_(0), friction_(0), res_friction_(0), cohesion_(0), tension_(0), dilation_(0),
                                 report_(false), tan_friction_(0), tan_res_friction_(0), tan_dilation_(0) {}

    string JModelSlip9::getName() const { return "slip9"; }
    string JModelSlip9::getFullName() const { return "Coulomb slip, 3DEC 9"; }
    uint32 JModelSlip9::getMinorVersion() const { return UPDATE_VERSION; }
    string JModelSlip9::getProperties() const {
        return "stiffness-normal kn, stiffness-shear ks, friction, friction-residual, cohesion, tension, dilation, report, note";
    }
    string JModelSlip9::getStates() const { return "slip-n,tension-n,slip-p,tension-p"; }

    base::Property JModelSlip9::getProperty(uint32 index) const {
        switch (index) {
        case 1: return kn_;
        case 2: return ks_;
        case 3: return friction_;
        case 4: return res_friction_;
        case 5: return cohesion_;
        case 6: return tension_;
        case 7: return dilation_;
        case 8: return report_;
        case 9: return note_;
        }
        return 0.0;
    }

    void JModelSlip9::setProperty(uint32 index, const base::Property &prop, uint32 restoreVersion) {
        JointModel::setProperty(index, prop, restoreVersion);
        switch (index) {
        case 1: kn_ = prop.to<double>(); break;
        case 2: ks_ = prop.to<double>(); break;
        case 3: friction_ = prop.to<double>(); break;
        case 4: res_friction_ = prop.to<double>(); break;
        case 5: cohesion_ = prop.to<double>(); break;
        case 6: tension_ = prop.to<double>(); break;
        case 7: dilation_ = prop.to<double>(); break;
        case 8: report_ = prop.to<bool>(); break;
        case 9: note_ = prop.to<string>(); break;
        }
    }

    void JModelSlip9::copy(const JointModel *m) {
        JointModel::copy(m);
        const JModelSlip9 *em = dynamic_cast<const JModelSlip9 *>(m);
        if (!em) throw std::runtime_error("Internal error: joint model dynamic cast failed.");
        kn_ = em->kn_; ks_ = em->ks_; friction_ = em->friction_; res_friction_ = em->res_friction_;
        cohesion_ = em->cohesion_; tension_ = em->tension_; dilation_ = em->dilation_; report_ = em->report_; note_ = em->note_;
    }

    void JModelSlip9::scaleProperties(const double &scale, const std::vector<uint32> &props) {
        for (uint32 u : props) {
            switch (u) {
            case 5: cohesion_ *= scale; break;
            case 6: tension_ *= scale; break;
            }
            setValid(0);
        }
    }

    double JModelSlip9::getEnergy(uint32 i) const {
        if (energies_ == nullptr) return 0.0;
        switch (i) {
        case 1: return energies_->slip_;
        case 2: return energies_->strain_;
        }
        return 0.0;
    }
    bool JModelSlip9::getEnergyAccumulate(uint32 i) const { return i == 1; }
    void JModelSlip9::setEnergy(uint32 i, const double &d) {
        if (energies_ == nullptr) return;
        if (i == 1) energies_->slip_ = d;
        if (i == 2) energies_->strain_ = d;
    }

    void JModelSlip9::initialize(uint32 dim, State *s) {
        JointModel::initialize(dim, s);
        tan_friction_ = tan(friction_ * dDegRad);
        tan_res_friction_ = tan(res_friction_ * dDegRad);
        tan_dilation_ = tan(dilation_ * dDegRad);
    }

    void JModelSlip9::run(uint32 dim, State *s) {
        JointModel::run(dim, s);
        if (s->state_ & slip_now) s->state_ |= slip_past;
        s->state_ &= ~slip_now;
        if (s->state_ & tension_now) s->state_ |= tension_past;
        s->state_ &= ~tension_now;
        bool failed = (s->state_ & (slip_past | tension_past)) != 0;

        s->normal_force_inc_ = -kn_ * s->area_ * s->normal_disp_inc_;
        s->normal_force_ += s->normal_force_inc_;
        double ften = failed ? 0.0 : -tension_ * s->area_;
        if (s->normal_force_ <= ften) {
            s->normal_force_ = 0.0;
            s->shear_force_ = DVect3(0, 0, 0);
            s->state_ |= tension_now;
            return;
        }
        s->shear_force_inc_ = s->shear_disp_inc_ * (-ks_ * s->area_);
        s->shear_force_ += s->shear_force_inc_;
        double tanphi = failed ? tan_res_friction_ : tan_friction_;
        double coh = failed ? 0.0 : cohesion_ * s->area_;
        double fsmax = std::max(0.0, coh + s->normal_force_ * tanphi);
        double fsm = s->shear_force_.mag();
        if (fsm > fsmax) {
            double slip = (fsm - fsmax) / (ks_ * s->area_);
            s->shear_force_ *= fsmax / fsm;
            s->normal_force_ += kn_ * s->area_ * tan_dilation_ * slip;
            s->state_ |= slip_now;
            if (s->trackEnergy() && energies_) energies_->slip_ += fsmax * slip;
        }
        if (energies_ && s->area_ > 0)
            energies_->strain_ = 0.5 * s->normal_force_ * s->normal_force_ / (kn_ * s->area_)
                               + 0.5 * s->shear_force_.mag() * s->shear_force_.mag() / (ks_ * s->area_);
        if (report_ && s->state_ & slip_now) throw std::runtime_error("slip, after a step of " + std::to_string(s->getTimeStep()));
    }
}
