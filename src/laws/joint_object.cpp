#include "laws/joint_object.hpp"

#include "base/diagnostic.hpp"

#include <exception>
#include <fmt/format.h>
#include <new>

namespace kaya {

namespace {

/// An object that only holds the saved bytes of another one.
struct Asleep {
    kaya_jobject head;
    std::string bytes;
};

const Asleep& asleep_of(const kaya_jobject* object) { return *reinterpret_cast<const Asleep*>(object); }

extern const kaya_jobject_functions asleep_functions;

kaya_jobject* make_asleep(std::string_view bytes) {
    return &(new Asleep{{&asleep_functions}, std::string(bytes)})->head;
}

const kaya_jobject_functions asleep_functions = {
    [](const kaya_jobject* object) { return make_asleep(asleep_of(object).bytes); },
    [](kaya_jobject* object) { delete reinterpret_cast<Asleep*>(object); },
    [](const kaya_jobject* object, void (*write)(void*, const void*, std::size_t), void* sink) {
        const auto& bytes = asleep_of(object).bytes;
        write(sink, bytes.data(), bytes.size());
    },
};

[[noreturn]] void fail(const char* doing, const std::string& why) {
    throw Diagnostic(fmt::format("a joint model could not {} what it keeps of a sub-contact: {}", doing, why),
                     "look at the library of the joint model", Fault::run);
}

} // namespace

JointObject::JointObject(const JointObject& other) {
    if (other.object_ == nullptr) return;
    try {
        object_ = other.object_->functions->clone(other.object_);
    } catch (const std::exception& thrown) { fail("copy", thrown.what()); } catch (...) {
        fail("copy", "it threw something other than a std::exception");
    }
    if (object_ == nullptr) fail("copy", "it gives no copy");
}

JointObject::~JointObject() {
    if (object_ == nullptr) return;
    try {
        object_->functions->destroy(object_);
    } catch (...) { // nothing depends on it any more
    }
}

std::string JointObject::bytes() const {
    std::string all;
    if (object_ == nullptr) return all;
    const auto write = [](void* sink, const void* bytes, std::size_t count) {
        static_cast<std::string*>(sink)->append(static_cast<const char*>(bytes), count);
    };
    try {
        object_->functions->save(object_, write, &all);
    } catch (const std::exception& thrown) { fail("save", thrown.what()); } catch (...) {
        fail("save", "it threw something other than a std::exception");
    }
    return all;
}

JointObject JointObject::asleep(std::string_view bytes) { return JointObject(make_asleep(bytes)); }

bool JointObject::is_asleep() const { return object_ != nullptr && object_->functions == &asleep_functions; }

} // namespace kaya
