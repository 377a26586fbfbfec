// A joint model in the manner of 3DEC 4 and 5: one file, texts in wide letters, words of properties and states in tables, a
// law that is read from a table of the deck by its number, static members, and what the Microsoft compiler lets pass.
#include "jointmodel.h"
#include "state.h"
#include "version.txt"
#include <vector>
#include <string>
#pragma warning(disable : 4100 4996)

using namespace std;

namespace jmodels {

enum { pKn = 1, pKs, pFric, pTable, pPull };

static const Double dToRad = atan(1.0) / 45.0;

struct Word { UInt index; const wchar_t *name; };
static const Word words[] = { { pKn, L"jkn kn" }, { pKs, L"jks ks" }, { pFric, L"jfriction fric" },
                              { pTable, L"jtable" }, { pPull, L"pull" } };

class ModelStairs : public JointModel {
public:
    ModelStairs() : dKn(0.0), dKs(0.0), dFric(0.0), iTable(0), vPull(0, 0, 0), pTab(NULL), dTan(0), lSteps(4, 0.0) { ++iMade; }
    ModelStairs(const ModelStairs &o) : JointModel(o), dKn(o.dKn), dKs(o.dKs), dFric(o.dFric), iTable(o.iTable), vPull(o.vPull),
                                        pTab(NULL), dTan(o.dTan), lSteps(o.lSteps) { ++iMade; }
    virtual ~ModelStairs() { --iMade; }
    virtual String getName() const {
#ifdef JMODELDEBUG
        return L"stairs" L"-debug";
#else
        return L"stairs";
#endif
    }
    virtual String getFullName() const { return String(L"Friction ") + L"from a table"; }
    virtual String getProperties() const {
        String sAll;
        for (size_t i = 0; i < sizeof(words) / sizeof(words[0]); ++i) {
            if (i) sAll += L" , ";
            sAll += words[i].name;
        }
        return sAll;
    }
    virtual String getStates() const { return L"slip-n,tension-n,slip-p,tension-p"; }
    virtual Variant getProperty(UInt index) const {
        switch (index) {
            case pKn:    return (dKn);
            case pKs:    return (dKs);
            case pFric:  return (dFric);
            case pTable: return (iTable);
            case pPull:  return (vPull);
        }
        return (0.0);
    }
    virtual void setProperty(UInt index, const Variant &prop) {
        JointModel::setProperty(index, prop);
        switch (index) {
            case pKn:    dKn = prop.toDouble(); break;
            case pKs:    dKs = prop.toDouble(); break;
            case pFric:  dFric = prop.toDouble(); break;
            case pTable: iTable = prop.toInt(); break;
            case pPull:  vPull = prop.to<DVect3>(); break;
            default: ;
        }
        if (_isnan(dKn) || !_finite(dKs)) throw std::exception("ModelStairs: a stiffness is not a number");
    }
    virtual JointModel *clone() const { return (NEWC(ModelStairs())); }
    virtual void copy(const JointModel *m) {
        JointModel::copy(m);
        ModelStairs *jm = (ModelStairs *)m;
        if (!jm) throw std::exception("Internal error");
        dKn = jm->dKn; dKs = jm->dKs; dFric = jm->dFric; iTable = jm->iTable; vPull = jm->vPull; lSteps = jm->lSteps;
    }
    virtual Double getMaxNormalStiffness() const { return dKn; }
    virtual Double getMaxShearStiffness() const { return dKs; }
    virtual void initialize(UByte dim, State *s) {
        JointModel::initialize(dim, s);
        dTan = tan(dFric * dToRad);
        pTab = iTable ? s->getTableIndexFromID(iTable) : NULL;
        if (iTable && !pTab) {
            char buf[80];
            sprintf_s(buf, sizeof(buf), "ModelStairs: there is no table %d", iTable);
            throw std::exception(buf);
        }
    }
    virtual void run(UByte dim, State *s) {
        JointModel::run(dim, s);
        Double &dSlip = s->working_[0];
        if (s->state_ & mSlipN) s->state_ |= mSlipP;
        s->state_ &= ~(mSlipN | mTenN);
        if (s->area_ <= 0) return;
        // Forces of the step and the law.
        s->normal_force_inc_ = -dKn * s->area_ * s->normal_disp_inc_;
        s->normal_force_ += s->normal_force_inc_;
        s->shear_force_inc_ = DVect3(s->shear_disp_inc_.x() * -dKs * s->area_, s->shear_disp_inc_.y() * -dKs * s->area_,
                                     s->shear_disp_inc_.z() * -dKs * s->area_);
        s->shear_force_ += s->shear_force_inc_;
        if (s->normal_force_ <= 0.0) {
            s->normal_force_ = 0.0;
            s->shear_force_ = DVect3(0, 0, 0);
            s->dnop_ = s->normal_disp_inc_;
            s->state_ |= mTenN;
            lSteps.clear();
            return;
        }
        Double dMu = pTab ? s->getYFromX(pTab, dSlip) : dTan;
        Double dMax = max(0.0, s->normal_force_ * dMu), dMag = s->shear_force_.mag();
        if (dMag > dMax) {
            dSlip += (dMag - dMax) / (dKs * s->area_);
            s->iworking_[0]++;
            s->shear_force_ *= dMax / dMag;
            s->state_ |= mSlipN;
            lSteps.push_back(dSlip);
            if (lSteps.size() > 4) lSteps.erase(lSteps.begin());
        }
    }
private:
    static const UInt mSlipN, mTenN;
    enum { mSlipP = 0x04, mTenP = 0x08 };
    static int iMade;
    Double dKn, dKs, dFric;
    Int iTable;
    DVect3 vPull;
    void *pTab;
    Double dTan;
    vector<Double> lSteps;
};

const UInt ModelStairs::mSlipN = 0x01;
const UInt ModelStairs::mTenN = 0x02;
int ModelStairs::iMade = 0;

} // namespace jmodels

#ifdef STAIRS_EXPORTS
int __stdcall DllMain(void *, unsigned, void *) { return 1; }
extern "C" __declspec(dllexport) const char *getName() { return "jmodelstairs"; }
extern "C" __declspec(dllexport) unsigned getMajorVersion() { return MAJOR_VERSION; }
extern "C" __declspec(dllexport) unsigned getMinorVersion() { return MINOR_VERSION; }
extern "C" __declspec(dllexport) void *createInstance() { jmodels::ModelStairs *m = new jmodels::ModelStairs(); return (void *)m; }
#endif
