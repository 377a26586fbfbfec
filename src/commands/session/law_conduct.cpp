#include "commands/session/law_conduct.hpp"

#include "commands/session/session.hpp"
#include "system/run_record.hpp"

#include <fmt/format.h>

namespace kaya {

namespace {

void warn_once(Session& session, const std::string& what, const char* hint) {
    if (!session.program.said_once.insert(what).second) return;
    Diagnostic warning(what, hint);
    warning.code = "joint-model-conduct";
    session.warn(std::move(warning));
}

} // namespace

void review_conduct(Session& session) {
    Host& host = *session.program.options.host;
    host.refuse_copies();
    std::string who;
    for (const auto& what : host.restored(who))
        warn_once(session, fmt::format("{} changed {}; it was restored", who, what),
                  "the process belongs to the whole run: correct the source of the model");
    const auto tell_of_threads = [&](const LawTable& law, const char* noun) {
        if (law.who() != nullptr && law.who()->starts_threads)
            warn_once(session, fmt::format("{} '{}' starts threads", noun, law.name),
                      "a thread that runs on after the call is not checked");
    };
    for (const auto& law : session.engine.joints.loaded()) tell_of_threads(*law, joint_law.noun);
    for (const auto& law : session.engine.joints.zones.loaded()) tell_of_threads(*law, zone_law.noun);
}

void review_conduct_in_cycle(Session& session, long cycle) {
    constexpr long between = 1000;
    if (cycle % between == 0) review_conduct(session);
    else session.program.options.host->refuse_copies();
}

} // namespace kaya
