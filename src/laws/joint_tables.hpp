// The tables of the deck as joint models see them.
#pragma once

#include "kaya/jmodel.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// Copies of the tables that joint models have requested. A copy is made at the first request and again by refresh(), so that a table
/// cannot change under a model that runs in many threads.
class JointTables {
public:
    struct Points {
        std::vector<double> x, y; ///< x does not decrease
    };
    /// Gives the points of a table by name or number, nullopt when there is none. Called under a lock.
    using Source = std::function<std::optional<Points>(const std::string& name)>;

    JointTables();
    JointTables(const JointTables&) = delete;
    JointTables& operator=(const JointTables&) = delete;

    void set_source(Source source) { source_ = std::move(source); }

    /// Copies the points again. Throws Diagnostic (Fault::run) for a deleted table.
    void refresh();

    const kaya_jtables* interface() const { return &interface_.functions; }

    const Points* find(const std::string& name);

private:
    struct Interface {
        kaya_jtables functions; // first, so that a pointer to it is a pointer to this
        JointTables* tables;
    };
    Interface interface_;
    Source source_;
    std::mutex lock_;
    std::map<std::string, std::unique_ptr<Points>> taken_;
};

/// The value at x: straight between points, constant beyond the ends; 0 without points.
double table_value(const JointTables::Points& points, double x);

/// The slope to the right of x; 0 beyond the ends.
double table_slope(const JointTables::Points& points, double x);

} // namespace kaya
