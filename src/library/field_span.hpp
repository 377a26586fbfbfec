// Fields of all objects of a kind, side by side in memory.
#pragma once

#include "commands/session/session.hpp"
#include "kaya/kaya.h"

#include <cstdint>
#include <string>
#include <vector>

namespace kaya::library {

/// The memory of one span.
class FieldSpan {
public:
    /// Reads a field. Throws Diagnostic when there is no such kind or field. The span lives until the next call.
    kaya_span read(Session& session, const std::string& kind, const std::string& name);

private:
    std::vector<double> numbers_;
    std::vector<std::int64_t> whole_;
    std::vector<std::string> texts_;
    std::vector<const char*> addresses_;
};

/// Sets a field of one object. Throws Diagnostic for an unknown name, a field that is only read, a row or a count that does not fit.
void set_field(Session& session, const std::string& kind, const std::string& name, std::size_t row,
               const double* numbers, std::size_t count);

} // namespace kaya::library
