#include "jmodelmemory.h"
#include "jmodels/src/state.h"
#include "version.txt"

#ifdef EXAMPLE_EXPORTS
int __stdcall DllMain(void *,unsigned, void *) { return 1; }
extern "C" EXPORT_TAG const char *getName() {
#ifdef JMODELDEBUG
    return "jmodelmemoryd";
#else
    return "jmodelmemory";
#endif
}
extern "C" EXPORT_TAG unsigned getMajorVersion() { return MAJOR_VERSION; }
extern "C" EXPORT_TAG unsigned getMinorVersion() { return UPDATE_VERSION; }
extern "C" EXPORT_TAG void *createInstance() { jmodels::JModelMemory *m = NEWC(jmodels::JModelMemory()); return (void *)m; }
#endif

namespace jmodels {
    namespace {
        const UInt slip_now = 0x01, slip_past = 0x04;
        template <class T> void put(std::ostream &o, const T &t) { o.write((const char *)&t, sizeof(T)); }
        template <class T> void get(std::istream &i, T &t) {
            i.read((char *)&t, sizeof(T));
            if (!i) throw std::runtime_error(std::string("jmodelmemory: the file ends too early"));
        }
    }

    JModelMemory::JModelMemory() : last_(NEWC(Double(0))) { }
    JModelMemory::~JModelMemory() { delete last_; }

    String JModelMemory::getName() const { return L"memory"; }
    String JModelMemory::getFullName() const { return L"Friction with a memory of reversals"; }
    UInt JModelMemory::getMinorVersion() const { return UPDATE_VERSION; }
    String JModelMemory::getProperties() const {
        return L"stiffness-normal        kn"
               L",stiffness-shear         ks"
               L",friction                jfriction"
               L",mode"
               L",label"
               L",reversals";
    }
    String JModelMemory::getStates() const { return L"slip-n  ,tension-n, slip-p,tension-p"; }

    Variant JModelMemory::getProperty(UInt ul) const {
        switch (ul) {
        case 1: return material_.kn;
        case 2: return material_.ks;
        case 3: return material_.friction;
        case 4: return static_cast<Int>(mode_);
        case 5: return label_;
        case 6: return (UInt)turns_.size();
        }
        return(0.0);
    }

    void JModelMemory::setProperty(UInt ul, const Variant &p, UInt restoreVersion) {
        JointModel::setProperty(ul, p, restoreVersion);
        switch (ul) {
        case 1: material_.kn = p.toDouble(); break;
        case 2: material_.ks = p.toDouble(); break;
        case 3: material_.friction = p.toDouble(); break;
        case 4: mode_ = static_cast<Mode>(p.toUInt()); break;
        case 5: label_ = p.toString(); break;
        }
    }

    void JModelMemory::copy(const JointModel *m) {
        JointModel::copy(m);
        const JModelMemory *em = dynamic_cast<const JModelMemory *>(m);
        if (!em) throw std::runtime_error("Internal error: joint model dynamic cast failed.");
        material_ = em->material_;
        mode_ = em->mode_;
        turns_ = em->turns_;
        label_ = em->label_;
        if (!last_) last_ = NEWC(Double(0));
        *last_ = *em->last_;
    }

    void JModelMemory::scaleProperties(const Double &scale, const std::vector<UInt> &props) {
        for (UInt u = 0; u < props.size(); ++u)
            if (props[u] == 3) material_.friction = std::max(0.0, std::min(89.0, std::atan(std::tan(material_.friction) * scale)));
        setValid(0);
    }

    void JModelMemory::initialize(UByte dim, State *s) {
        JointModel::initialize(dim, s);
        if (mode_ != Mode::loose && mode_ != Mode::tight) throw std::runtime_error("mode must be 0 or 1");
    }

    void JModelMemory::run(UByte dim, State *s) {
        JointModel::run(dim, s);
        const Double degrad = 3.14159265358979323846 / 180.0;
        s->state_ = (s->state_ & slip_now) ? ((s->state_ & ~slip_now) | slip_past) : s->state_;
        if (!s->area_) return;
        s->normal_force_ -= material_.kn * s->area_ * s->normal_disp_inc_;
        if (s->normal_force_ < 0) s->normal_force_ = 0;
        const DVect3 before(s->shear_force_);
        s->shear_force_ += s->shear_disp_inc_ * (material_.ks * s->area_ * -1);
        const Double way = s->shear_disp_inc_ | before;
        if (*last_ * way < 0) turns_.push_back(before);
        if (way != 0) *last_ = way;
        Double most = s->normal_force_ * std::tan(material_.friction * degrad);
        // It hardens with every turn when it is tight.
        if (mode_ == Mode::tight) most *= 1 + 0.1 * static_cast<Double>(turns_.size());
        const Double size = s->shear_force_.mag();
        if (size > most) {
            s->shear_force_ *= size > std::numeric_limits<Double>::epsilon() ? most / size : 0.0;
            s->state_ |= slip_now;
        }
    }

    void JModelMemory::save(std::ostream &o) const {
        put(o, *last_);
        put(o, (UInt)turns_.size());
        for (std::vector<DVect3>::const_iterator it = turns_.begin(); it != turns_.end(); ++it) {
            put(o, it->x()); put(o, it->y()); put(o, it->z());
        }
    }

    void JModelMemory::restore(std::istream &i, UInt) {
        get(i, *last_);
        UInt count(0);
        get(i, count);
        turns_.assign(count, DVect3(0, 0, 0));
        for (auto &t : turns_) {
            Double x, y, z;
            get(i, x); get(i, y); get(i, z);
            t = DVect3(x, y, z);
        }
    }
}
