/* SPDX-License-Identifier: MIT */
/* The value of a property, and the plain types by all the names that sources use. */
#ifndef KAYA_COMPAT_PROPERTY_H
#define KAYA_COMPAT_PROPERTY_H

#include "kaya/compat/platform.h"
#include "kaya/compat/text.h"
#include "kaya/compat/vector.h"

typedef std::int32_t int32;
typedef std::uint32_t uint32;
typedef std::int32_t Int;
typedef std::uint32_t UInt;
typedef std::uint32_t UByte; /* one type with UInt, so that one virtual function serves all dialects */
typedef double Double;
typedef bool Bool;

/* A source that returns std::string where it means the text class is compiled with
 * KAYA_COMPAT_STD_STRING. `string` stands in the namespaces of models only: at global scope it would clash
 * with `using namespace std`. */
#if defined(KAYA_COMPAT_STD_STRING)
typedef std::string String;
#else
typedef kaya_compat::text String;
#endif

namespace base {

typedef String string;

class Property {
public:
    enum class Kind { none, real, whole, truth, text, vector };

    Property() = default;
    Property(double value) : kind_(Kind::real), number_(value) {}
    Property(float value) : kind_(Kind::real), number_(value) {}
    Property(int value) : kind_(Kind::whole), number_(value) {}
    Property(unsigned value) : kind_(Kind::whole), number_(value) {}
    Property(long value) : kind_(Kind::whole), number_(static_cast<double>(value)) {}
    Property(unsigned long value) : kind_(Kind::whole), number_(static_cast<double>(value)) {}
    Property(long long value) : kind_(Kind::whole), number_(static_cast<double>(value)) {}
    Property(unsigned long long value) : kind_(Kind::whole), number_(static_cast<double>(value)) {}
    Property(bool value) : kind_(Kind::truth), number_(value) {}
    Property(const char* value) : kind_(Kind::text), text_(value ? value : "") {}
    Property(const wchar_t* value) : kind_(Kind::text), text_(kaya_compat::narrow(value)) {}
    Property(const std::string& value) : kind_(Kind::text), text_(value) {}
    Property(const kaya_compat::text& value) : kind_(Kind::text), text_(value) {}
    Property(const DVect3& value) : kind_(Kind::vector), vector_(value) {}

    Kind kind() const { return kind_; }

    /* A text that is not a number is 0. */
    double toDouble() const { return kind_ == Kind::text ? std::strtod(text_.c_str(), nullptr) : number_; }
    Int toInt() const { return static_cast<Int>(whole()); }
    UInt toUInt() const { return static_cast<UInt>(whole()); }
    bool toBool() const {
        if (kind_ != Kind::text) return number_ != 0;
        return text_ == "true" || text_ == "on" || text_ == "yes" || toDouble() != 0;
    }
    /* A whole number has no decimal point: as a text it may be the number of a table. */
    String toString() const {
        if (kind_ == Kind::text) return text_;
        if (kind_ == Kind::truth) return number_ != 0 ? "true" : "false";
        char digits[96];
        if (kind_ == Kind::vector)
            std::snprintf(digits, sizeof digits, "(%.17g,%.17g,%.17g)", vector_.x(), vector_.y(), vector_.z());
        else if (kind_ == Kind::none) digits[0] = '\0';
        else std::snprintf(digits, sizeof digits, "%.17g", number_);
        return digits;
    }
    DVect3 toVector() const { return vector_; }

    template <class T> T to() const { return convert(static_cast<T*>(nullptr)); }

private:
    long long whole() const { return static_cast<long long>(toDouble()); }
    template <class T> T convert(T*) const {
        return static_cast<T>(std::is_floating_point<T>::value ? toDouble() : static_cast<double>(whole()));
    }
    bool convert(bool*) const { return toBool(); }
    std::string convert(std::string*) const { return toString(); }
    kaya_compat::text convert(kaya_compat::text*) const { return toString(); }
    DVect3 convert(DVect3*) const { return vector_; }

    Kind kind_ = Kind::none;
    double number_ = 0;
    std::string text_;
    DVect3 vector_;
};

} // namespace base

typedef base::Property Variant;

namespace jmodels {
typedef String string;
}
namespace models {
typedef String string;
}

#endif
