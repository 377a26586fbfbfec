/* SPDX-License-Identifier: MIT */
/* Makes a native joint model (kaya/jmodel.h) of a class derived from jmodels::JointModel. It is compiled
 * into the same shared library as the source of that class, whose four exports it calls. One object of the
 * class stands for one sub-contact, as its author expects. */
#include "kaya/compat/bytes.h"
#include "kaya/compat/class_table.h"
#include "kaya/compat/jointmodel.h"
#include "kaya/jmodel.h"

#include <cstddef>
#include <mutex>

namespace {

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/* Values that objects were given, each set once: objects with the same set share it, so that a change of values is found by
 * comparing two pointers. */
typedef std::shared_ptr<const std::vector<double>> Values;

bool same_values(const std::vector<double>& a, const double* b) {
    return a.empty() || std::memcmp(a.data(), b, a.size() * sizeof(double)) == 0;
}

Values values_like(const double* values) {
    static thread_local Values last; /* batches of one set follow each other */
    if (last && same_values(*last, values)) return last;
    static std::mutex lock;
    static std::vector<std::weak_ptr<const std::vector<double>>> known;
    const std::lock_guard<std::mutex> guard(lock);
    last.reset();
    std::size_t kept = 0;
    for (auto& each : known) {
        Values there = each.lock();
        if (!there) continue; /* no object has it any more */
        if (same_values(*there, values)) last = std::move(there);
        known[kept++] = std::move(each);
    }
    known.resize(kept);
    if (!last) {
        last = std::make_shared<const std::vector<double>>(values, values + metadata->slots.size());
        known.push_back(last);
    }
    return last;
}

/* Sets the values that differ from those which the model was given last. */
void apply(JointModel& model, Values& applied, const Values& values, UInt version) {
    if (applied == values) return;
    for (std::size_t k = 0; k < values->size(); ++k)
        if (!same_bits((*applied)[k], (*values)[k])) set_property(model, metadata->slots[k], (*values)[k], version);
    applied = values;
}

/* ----- one sub-contact ----- */

extern const kaya_jobject_functions object_functions;

/* The rest of a State comes with each call. */
struct Kept {
    Double working[State::max_working_] = {};
    Int iworking[State::max_iworking_] = {};

    void take(const State& s) {
        std::memcpy(working, s.working_, sizeof working);
        std::memcpy(iworking, s.iworking_, sizeof iworking);
    }
    void give(State& s) const {
        std::memcpy(s.working_, working, sizeof working);
        std::memcpy(s.iworking_, iworking, sizeof iworking);
    }
};

struct Object {
    kaya_jobject head{&object_functions};
    ModelPointer model;
    Values applied;
    Kept kept;

    explicit Object(ModelPointer of) : model(std::move(of)), applied(values_like(metadata->initial.data())) {
        model->activateEnergy();
    }
};

Object* object_of(kaya_jobject* head) { return reinterpret_cast<Object*>(head); }
const Object* object_of(const kaya_jobject* head) { return reinterpret_cast<const Object*>(head); }

ModelPointer copy_of(const JointModel& model) {
    ModelPointer copy(model.clone());
    if (!copy) throw std::runtime_error("clone() gives no object");
    copy->copy(&model);
    copy->setIfCanFail(model.canFail());
    return copy;
}

std::string own_bytes(const JointModel& model) {
    std::ostringstream stream;
    model.save(stream);
    return stream.str();
}

void take_energies(JointModel& to, JointModel& from) {
    for (std::size_t k = 0; k < metadata->energies.size(); ++k) {
        const UInt index = static_cast<UInt>(k + 1);
        to.setEnergy(index, from.getEnergy(index));
    }
}

kaya_jobject* clone_object(const kaya_jobject* head) {
    const Object& from = *object_of(head);
    auto to = std::unique_ptr<Object>(new Object(copy_of(*from.model)));
    const std::string bytes = own_bytes(*from.model);
    if (!bytes.empty()) {
        std::istringstream stream(bytes);
        to->model->restore(stream, metadata->minor);
    }
    to->kept = from.kept;
    to->applied = from.applied;
    take_energies(*to->model, *from.model);
    return &to.release()->head;
}

void destroy_object(kaya_jobject* head) { delete object_of(head); }

/* ----- a save file ----- */

using kaya_compat::Reader;
using kaya_compat::Writer;

/* Each property once: the components of a vector have one number. */
template <class Visit> void each_property(Visit visit) {
    UInt last = 0;
    for (const auto& slot : metadata->slots) {
        if (slot.index != last) visit(slot.index);
        last = slot.index;
    }
}

void save_object(const kaya_jobject* head, void (*write)(void*, const void*, size_t), void* sink) {
    const Object& object = *object_of(head);
    Writer writer(write, sink);
    for (const double value : *object.applied) writer.plain(value);
    each_property([&](UInt index) { kaya_compat::write_property(writer, object.model->getProperty(index)); });
    for (const double value : object.kept.working) writer.plain(value);
    for (const Int value : object.kept.iworking) writer.plain(value);
    for (std::size_t k = 0; k < metadata->energies.size(); ++k)
        writer.plain(object.model->getEnergy(static_cast<UInt>(k + 1)));
    writer.plain(metadata->minor);
    writer.text(own_bytes(*object.model));
}

const kaya_jobject_functions object_functions = {clone_object, destroy_object, save_object};

/* The object comes back not valid: its first run calls initialize(), which finds its tables again. */
Object* read_object(Reader& reader) {
    auto object = std::unique_ptr<Object>(new Object(copy_of(*metadata->pattern)));
    std::vector<double> applied(metadata->slots.size());
    for (double& value : applied) value = reader.plain<double>();
    object->applied = values_like(applied.data());
    each_property(
        [&](UInt index) { object->model->setProperty(index, kaya_compat::read_property(reader), from_restore); });
    for (double& value : object->kept.working) value = reader.plain<double>();
    for (Int& value : object->kept.iworking) value = reader.plain<Int>();
    for (std::size_t k = 0; k < metadata->energies.size(); ++k)
        object->model->setEnergy(static_cast<UInt>(k + 1), reader.plain<double>());
    const auto version = reader.plain<UInt>();
    const std::string bytes = reader.text();
    if (!bytes.empty()) {
        std::istringstream stream(bytes);
        object->model->restore(stream, version);
    }
    return object.release();
}

/* ----- what sources throw ----- */

/* Calls `work`; false after writing to message what it threw. */
template <class Work> bool guarded(char* message, Work work) {
    std::string said;
    try {
        work();
        return true;
    } catch (const std::exception& thrown) { said = thrown.what(); } catch (const std::string& thrown) {
        said = thrown;
    } catch (const char* thrown) { said = thrown ? thrown : ""; } catch (const wchar_t* thrown) {
        said = kaya_compat::narrow(thrown);
    } catch (int thrown) { said = "it threw the number " + std::to_string(thrown); } catch (...) {
        said = "it threw something other than a std::exception";
    }
    std::snprintf(message, KAYA_JMODEL_MESSAGE, "%s", said.empty() ? "it gives no reason" : said.c_str());
    return false;
}

/* ----- the functions of the descriptor ----- */

void fill_state(State& s, const kaya_jbatch& b, size_t i) {
    s.state_ = b.state[i];
    s.area_ = b.area[i];
    s.normal_force_ = b.normal_force[i];
    s.shear_force_ = DVect3(b.shear_force[0][i], b.shear_force[1][i], b.shear_force[2][i]);
    s.normal_disp_ = b.normal_disp[i];
    s.shear_disp_ = DVect3(b.shear_disp[0][i], b.shear_disp[1][i], b.shear_disp[2][i]);
    s.normal_disp_inc_ = b.normal_disp_inc[i];
    s.shear_disp_inc_ = DVect3(b.shear_disp_inc[0][i], b.shear_disp_inc[1][i], b.shear_disp_inc[2][i]);
#if defined(KAYA_COMPAT_DISPLACEMENT_AT_END)
    s.normal_disp_ += s.normal_disp_inc_;
    s.shear_disp_ += s.shear_disp_inc_;
#endif
    s.normal_force_inc_ = 0;
    s.shear_force_inc_ = DVect3();
    s.dnop_ = s.normal_disp_inc_;
    s.time_step_ = b.time_step;
    s.fluid_ = b.pore_pressure[i] != 0;
    s.tables_ = b.tables;
}

void take_stiffness(kaya_jbatch& b, size_t i, const JointModel& model) {
    const double normal = model.getMaxNormalStiffness(), shear = model.getMaxShearStiffness();
    if (!same_bits(normal, b.normal_stiffness[i]) || !same_bits(shear, b.shear_stiffness[i])) b.stiffness_changed = 1;
    b.normal_stiffness[i] = normal;
    b.shear_stiffness[i] = shear;
}

double spring_energy(double force2, double stiffness) { return stiffness > 0 ? 0.5 * force2 / stiffness : 0; }

/* What a step took up: the work of the mean forces, less what the springs hold more than before, all with
 * the stiffness that the model reports. */
double taken_up(const kaya_jbatch& b, size_t i, double old_normal, const DVect3& old_shear, const State& s) {
    const double kn = b.normal_stiffness[i] * s.area_, ks = b.shear_stiffness[i] * s.area_;
    const double work = -0.5 * (old_normal + s.normal_force_) * b.normal_disp_inc[i] -
                        0.5 * ((old_shear + s.shear_force_) | s.shear_disp_inc_);
    const double held = spring_energy(s.normal_force_ * s.normal_force_, kn) + spring_energy(s.shear_force_.mag2(), ks);
    const double before = spring_energy(old_normal * old_normal, kn) + spring_energy(old_shear.mag2(), ks);
    return work - (held - before);
}

/* What the rows of one call share. */
struct Call {
    kaya_jbatch& batch;
    Values values;
    State state;
};

void initialise_row(Call& call, size_t i);

/* Objects lie anywhere; what comes soon is fetched while the model works. */
inline void fetch_ahead(const kaya_jbatch& b, size_t i) {
#if defined(__GNUC__)
    constexpr size_t far = 6, near = 3, line = 64, model_lines = 8;
    if (i + far < b.n && b.object[i + far]) {
        __builtin_prefetch(b.object[i + far]);
        __builtin_prefetch(reinterpret_cast<const char*>(b.object[i + far]) + line);
    }
    if (i + near < b.n && b.object[i + near]) {
        const char* model = reinterpret_cast<const char*>(object_of(b.object[i + near])->model.get());
        for (size_t k = 0; k < model_lines; ++k) __builtin_prefetch(model + k * line);
    }
#else
    (void)b, (void)i;
#endif
}

void run_row(Call& call, size_t i) {
    kaya_jbatch& b = call.batch;
    State& s = call.state;
    fetch_ahead(b, i);
    if (!b.object[i]) initialise_row(call, i);
    Object& object = *object_of(b.object[i]);
    apply(*object.model, object.applied, call.values, from_command);
    object.kept.give(s);
    fill_state(s, b, i);
    const double old_normal = s.normal_force_;
    const DVect3 old_shear = s.shear_force_;
    object.model->run(dimensions, &s);
    object.kept.take(s);
    b.normal_force[i] = s.normal_force_;
    b.shear_force[0][i] = s.shear_force_.x();
    b.shear_force[1][i] = s.shear_force_.y();
    b.shear_force[2][i] = s.shear_force_.z();
    b.state[i] = s.state_;
    take_stiffness(b, i, *object.model);
    b.frictional_work[i] += taken_up(b, i, old_normal, old_shear, s);
    for (std::size_t k = 0; k < metadata->energies.size(); ++k)
        b.history[k][i] = object.model->getEnergy(static_cast<UInt>(k + 1));
}

void initialise_row(Call& call, size_t i) {
    kaya_jbatch& b = call.batch;
    if (!b.object[i]) b.object[i] = &(new Object(copy_of(*metadata->pattern)))->head;
    Object& object = *object_of(b.object[i]);
    apply(*object.model, object.applied, call.values, from_command);
    /* initialize() itself is called by the first run: all properties have been given then. */
    object.model->setValid(0);
    take_stiffness(b, i, *object.model);
}

template <void (*work)(Call&, size_t)> ptrdiff_t each_row(kaya_jbatch* b) {
    const bool well = guarded(b->message, [b] {
        Call call{*b, values_like(b->properties), State()};
        for (b->row = 0; b->row < b->n; ++b->row) work(call, b->row);
    });
    return well ? -1 : static_cast<ptrdiff_t>(std::min(b->row, b->n - 1));
}

ModelPointer with_values(const double* values) {
    ModelPointer model = copy_of(*metadata->pattern);
    Values applied = values_like(metadata->initial.data());
    apply(*model, applied, values_like(values), from_command);
    return model;
}

const char* check(const double* values) {
    static char message[KAYA_JMODEL_MESSAGE];
    return guarded(message, [values] { with_values(values); }) ? nullptr : message;
}

/* Some classes know their stiffness only after initialize(). */
void max_stiffness(const double* values, double* normal, double* shear) {
    const ModelPointer model = with_values(values);
    *normal = model->getMaxNormalStiffness();
    *shear = model->getMaxShearStiffness();
    if (*normal > 0) return;
    State state;
    state.area_ = 1;
    model->initialize(dimensions, &state);
    *normal = model->getMaxNormalStiffness();
    *shear = model->getMaxShearStiffness();
}

kaya_jobject* restore(const double*, const void* bytes, size_t count, char* message) {
    Object* object = nullptr;
    guarded(message, [&] {
        Reader reader(bytes, count);
        object = read_object(reader);
    });
    return object ? &object->head : nullptr;
}

double object_value(const kaya_jobject* head, size_t property) {
    const Slot& slot = metadata->slots[property];
    return number_of(object_of(head)->model->getProperty(slot.index), slot);
}

/* The deck's value stays what it was given last: the next one that differs from that reaches the object again. */
int set_object_value(kaya_jobject* head, size_t property, double value) {
    set_property(*object_of(head)->model, metadata->slots[property], value, from_command);
    return 0;
}

kaya_jmodel describe() {
    if (!createInstance || !getMajorVersion)
        throw std::runtime_error("it exports no createInstance() and getMajorVersion(); perhaps a macro of its "
                                 "source keeps them away: define that macro when it is built");
    const unsigned major = getMajorVersion();
    if (major < 4 || major > 9)
        throw std::runtime_error("it was written for interface version " + std::to_string(major) +
                                 " of joint models; versions 4 to 9 are understood");
    metadata = new Metadata(read_metadata());
    const Metadata& m = *metadata;
    kaya_jmodel d{};
    d.interface_version = KAYA_JMODEL_INTERFACE;
    d.size = sizeof d;
    d.name = m.name.c_str();
    d.title = m.title.c_str();
    d.version = m.version.c_str();
    d.properties = m.properties.data();
    d.property_count = m.properties.size();
    d.history = m.energies.data();
    d.history_count = m.energies.size();
    d.state_names = m.states.c_str();
    d.initialise = each_row<initialise_row>;
    d.run = each_row<run_row>;
    d.check = check;
    d.max_stiffness = max_stiffness;
    d.restore = restore;
    d.object_value = object_value;
    d.set_object_value = set_object_value;
    return d;
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static const kaya_jmodel model = describe();
    return &model;
}
