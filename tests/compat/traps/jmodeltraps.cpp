// Constructs that a strict compiler on another system rejects: no version.txt next to the source, `using namespace
// std`, std::string where the base has its own text, headers inside the namespace, assert and abs without their headers,
// a ratio with an older list of arguments, overrides without const, its own kind of exception, a name with blanks.
#include "jmodels/src/jointmodel.h"
#include "jmodels/src/state.h"
#include "version.txt"

using namespace std;

#if defined(TRAPS_LIB) && defined(JMODELTRAPS_EXPORTS)
int __stdcall DllMain(void *, unsigned, void *) { return 1; }
extern "C" __declspec( dllexport ) const char *getName() { return "anything"; }
extern "C" __declspec( dllexport ) unsigned getMajorVersion() { return MAJOR_VERSION; }
extern "C" __declspec( dllexport ) unsigned getMinorVersion() { return MINOR_VERSION; }
extern "C" __declspec( dllexport ) void *createInstance();
#endif

namespace jmodels {
#include <cmath>
    class JMODEL_EXPORT Traps : public JointModel {
    public:
        std::string getName() const { return "Traps  "; }
        std::string getFullName() const { return "Traps, " + std::to_string(3); }
        std::string getProperties() const { return " kn,ks ,, k-shear ks, 5th , mode,"; }
        std::string getStates() const { return "slip now,,broken"; }
        Variant getProperty(UInt index) const {
            switch (index) {
            case 1: return kn_;
            case 2: return ks_;
            case 4: return other_;
            case 6: return mode_;
            }
            return 0.0;
        }
        void setProperty(UInt index, const Variant &prop, UInt version = 0) {
            JointModel::setProperty(index, prop);
            if (index == 1) kn_ = prop.toDouble();
            if (index == 2) ks_ = prop.toDouble();
            if (index == 4) other_ = prop.toDouble();
            if (index == 6) mode_ = prop.toInt();
            if (kn_ < 0) throw "a negative stiffness";
        }
        Traps *clone() const { return NEWC(Traps(*this)); }
        // Known after initialize() only.
        Double getMaxNormalStiffness() const { return max_; }
        Double getMaxShearStiffness() const { return ks_; }
        Double getStrengthStressRatio(const Double &, const DVect3 &) const { return 1; }
        bool isSliding(const State &s) { return s.state_ == 1; }
        string getEnergies() { return "energy-lost"; }
        Double getEnergy(UInt) { return lost_; }
        void setEnergy(UInt, const Double &e) { lost_ = e; }
        void initialize(UByte dim, State *s) {
            JointModel::initialize(dim, s);
            assert(dim == 3);
            max_ = max(kn_, other_);
        }
        void run(UByte dim, State *s) {
            JointModel::run(dim, s);
            if (mode_ == 1) throw std::exception("thrown by std::exception");
            if (mode_ == 2) throw std::string("thrown as a text");
            if (mode_ == 3) throw 77;
            if (mode_ == 4) throw std::logic_error("a logic error");
            s->normal_force_ -= max_ * s->area_ * s->normal_disp_inc_;
            s->shear_force_ += s->shear_disp_inc_ * (-ks_ * s->area_);
            if (abs(s->normal_disp_inc_) < 0.5 && s->normal_disp_inc_ != 0) lost_ += abs(s->normal_disp_inc_);
        }
        Double kn_ = 0, ks_ = 0, other_ = 0, max_ = 0, lost_ = 0;
        Int mode_ = 0;
    };
}

extern "C" void *createInstance() { return static_cast<void *>(new jmodels::Traps); }
