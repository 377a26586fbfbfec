// The object that a joint model may store for each sub-contact.
#pragma once

#include "kaya/jmodel.h"

#include <string>
#include <string_view>
#include <utility>

namespace kaya {

/// Owns one object, or none. A copy is a clone. It has the size of a pointer, so that a column of them is the column of pointers that a
/// batch has.
class JointObject {
public:
    JointObject() = default;
    explicit JointObject(kaya_jobject* object) : object_(object) {}
    JointObject(const JointObject& other);
    JointObject(JointObject&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    JointObject& operator=(JointObject other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    ~JointObject();

    explicit operator bool() const { return object_ != nullptr; }
    void reset() { *this = JointObject(); }

    /// The bytes that the object saves, "" when there is no object. Throws Diagnostic when the model throws.
    std::string bytes() const;

    /// Bytes of an object whose joint model is not loaded yet; they are stored unchanged.
    static JointObject asleep(std::string_view bytes);
    bool is_asleep() const;

    kaya_jobject** address() { return &object_; }
    const kaya_jobject* get() const { return object_; }

private:
    kaya_jobject* object_ = nullptr;
};

static_assert(sizeof(JointObject) == sizeof(kaya_jobject*));

} // namespace kaya
