// A joint model in the manner of 3DEC 9: modern C++ in one file, standard containers as members, tables by name, energies with
// `override`, helpers in an unnamed namespace, an exception that says what was not a number.
#include "jointmodel.h"
#include "state.h"
#include "version.txt"
#include <array>
#include <map>
#include <optional>
#include <string_view>

namespace jmodels {
#include <cmath>
    using namespace std::string_literals;

    namespace {
        constexpr double degrad = 0.017453292519943295;
        enum Index : uint32 { i_kn = 1, i_ks, i_coh, i_fric, i_ten, i_tab, i_gii, i_dam, i_last = i_dam };
        enum StateBit : uint32 { slip_now = 1u << 0, tension_now = 1u << 1, slip_past = 1u << 2, tension_past = 1u << 3, crush_now = 1u << 4, crush_past = 1u << 5 };
        inline double macaulay(double x) { return x > 0.0 ? x : 0.0; }
    }

    class JModelBrick9 final : public JointModel {
    public:
        JModelBrick9() = default;
        JModelBrick9(const JModelBrick9 &) = delete;
        string    getName() const override { return "brick9"; }
        string    getFullName() const override { return "Mortar joint, "s + std::to_string(i_last) + " properties"; }
        string    getPluginName() const override { return getName(); }
        uint32    getMinorVersion() const override { return UPDATE_VERSION; }
        string    getProperties() const override {
            return "stiffness-normal     kn, stiffness-shear ks , cohesion, friction fric,tension ,"
                   "table-softening, energy-fracture g-ii, damage";
        }
        string    getStates() const override { return "slip-n,tension-n,slip-p,tension-p,crush-n,crush-p"; }
        base::Property getProperty(uint32 index) const override {
            if (index == i_tab) return table_;
            if (index == i_dam) return damage_;
            const auto it = values_.find(index);
            return it == values_.end() ? base::Property(0.0) : base::Property(it->second);
        }
        void      setProperty(uint32 index, const base::Property &p, uint32 restoreVersion = 0) override {
            JointModel::setProperty(index, p, restoreVersion);
            if (index == i_tab) table_ = p.to<string>();
            else if (index == i_dam) { if (restoreVersion || p.to<double>() != 0.0) damage_ = p.to<double>(); }
            else if (index <= i_last) values_[index] = p.to<double>();
        }
        JModelBrick9 *clone() const override { return new JModelBrick9(); }
        double    getMaxNormalStiffness() const override { return get(i_kn); }
        double    getMaxShearStiffness() const override { return get(i_ks); }
        void      copy(const JointModel *m) override {
            JointModel::copy(m);
            const auto *em = dynamic_cast<const JModelBrick9 *>(m);
            if (!em) throw std::runtime_error("Internal error: joint model dynamic cast failed.");
            values_ = em->values_;
            table_ = em->table_;
            damage_ = em->damage_;
        }
        void      initialize(uint32 dim, State *s) override {
            JointModel::initialize(dim, s);
            for (const auto &[index, value] : values_)
                if (std::isnan(value)) throw std::runtime_error("brick9: property " + std::to_string(index) + " is not a number");
            tab_.reset();
            if (!table_.empty() && table_ != "0") {
                if (void *t = s->getTableIndexFromID(table_)) tab_ = t;
                else throw std::runtime_error("brick9: there is no table '" + table_ + "'");
            }
        }
        void      run(uint32 dim, State *s) override {
            JointModel::run(dim, s);
            for (auto [now, past] : std::initializer_list<std::pair<uint32, uint32>>{{slip_now, slip_past}, {tension_now, tension_past}})
                if (s->state_ & now) s->state_ = (s->state_ & ~now) | past;
            const double a = s->area_;
            if (a <= 0.0) return;
            const auto left = [&] { return tab_ ? s->getYFromX(*tab_, damage_) : std::exp(-damage_ * get(i_coh) / std::max(get(i_gii), 1e-300)); };
            const double keep = get(i_gii) > 0.0 || tab_ ? left() : 1.0;
            s->normal_force_ -= get(i_kn) * a * s->normal_disp_inc_;
            s->shear_force_ += s->shear_disp_inc_ * -(get(i_ks) * a);
            if (s->normal_force_ < -keep * get(i_ten) * a) {
                s->normal_force_ = 0.0;
                s->shear_force_ = DVect3(0.0, 0.0, 0.0);
                s->state_ |= tension_now;
                damage_ = 1e3;
                return;
            }
            const double most = macaulay(keep * get(i_coh) * a + s->normal_force_ * std::tan(get(i_fric) * degrad));
            const double size = s->shear_force_.mag();
            if (size > most) {
                const double slip = (size - most) / (get(i_ks) * a);
                damage_ += slip;
                s->shear_force_ *= most / size;
                s->state_ |= slip_now;
                if (s->trackEnergy() && energies_) (*energies_)[0] += most * slip;
            }
            if (energies_) (*energies_)[1] = s->normal_force_ * s->normal_force_ / (2.0 * get(i_kn) * a);
            if (!std::isfinite(s->normal_force_)) throw std::runtime_error("brick9: the normal force is not a number");
        }
        bool      isSliding(const State &s) const override { return (s.state_ & slip_now) != 0; }
        bool      isBonded(const State &s) const override { return s.state_ == 0; }
        bool      supportsStrengthStressRatio() const override { return true; }
        double    getStrengthStressRatio(const double &, const DVect3 &) const { return 10.0; }
        bool      supportsPropertyScaling() const override { return true; }
        void      scaleProperties(const double &scale, const std::vector<uint32> &props) override {
            for (auto u : props) values_[u] *= scale;
            setValid(0);
        }
        string    getEnergies() const override { return "energy-slip,energy-strain"; }
        double    getEnergy(uint32 i) const override { return energies_ ? energies_->at(i - 1) : 0.0; }
        bool      getEnergyAccumulate(uint32 i) const override { return i == 1; }
        void      setEnergy(uint32 i, const double &e) override { if (energies_) energies_->at(i - 1) = e; }
        void      activateEnergy() override { if (!energies_) energies_ = std::make_unique<std::array<double, 2>>(); }
        bool      getEnergyActivated() const override { return energies_ != nullptr; }
    private:
        double    get(uint32 index) const { auto it = values_.find(index); return it == values_.end() ? 0.0 : it->second; }
        std::map<uint32, double> values_;
        string    table_;
        double    damage_ = 0.0;
        std::optional<void *> tab_;
        std::unique_ptr<std::array<double, 2>> energies_;
    };
}

extern "C" EXPORT_TAG const char *getName() { return "jmodelbrick9"; }
extern "C" EXPORT_TAG unsigned getMajorVersion() { return MAJOR_VERSION; }
extern "C" EXPORT_TAG unsigned getMinorVersion() { return UPDATE_VERSION; }
extern "C" EXPORT_TAG void *createInstance() { return static_cast<void *>(new jmodels::JModelBrick9()); }
