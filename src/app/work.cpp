#include "app/work.hpp"

#include "app/run.hpp"
#include "app/start.hpp"
#include "base/diagnostic.hpp"
#include "base/terminal_text.hpp"
#include "system/crash_report.hpp"
#include "system/limits.hpp"
#include "system/memory.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <system_error>

namespace {

/// TBB throws where it cannot be caught when the system gives it no thread, usually for lack of memory.
[[noreturn]] void end_without_threads() {
    try {
        if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
        if (std::string_view(error.what()).find("pthread_create") != std::string_view::npos) {
            std::fflush(stdout);
            kaya::print_text(
                stderr,
                fmt::format(
                    "error: the system gives no more threads ({}); there is not enough memory, or too many run\n",
                    error.what()));
            std::_Exit(static_cast<int>(kaya::Fault::run));
        }
    } catch (...) { // the crash report names it
    }
    std::abort();
}

} // namespace

int kaya::work(int argc, char** argv) {
    std::set_terminate(end_without_threads);
    // A file that grows beyond the limit, or a reader that went away, is an error of the write that met
    // it, not the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    kaya::report_crashes();
    kaya::limit_memory_to_available();
    kaya::keep_freed_memory();
    std::string words = "kaya";
    for (int k = 1; k < argc; ++k) words += std::string(" ") + argv[k];
    const kaya::AtCommand at_command(words);
    try {
        kaya::require_stack_and_files();
        return kaya::start(argc, argv);
    } catch (const std::bad_alloc&) {
        kaya::print_text(stderr, "error: there is not enough memory to begin\n");
        return static_cast<int>(kaya::Fault::run);
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::broken_pipe) return kaya::nobody_reads;
        kaya::print_text(stderr, fmt::format("error: {}\n", error.what()));
        return static_cast<int>(kaya::Fault::run);
    } catch (const kaya::Diagnostic& error) {
        if (error.code == kaya::broken_pipe) return kaya::nobody_reads;
        kaya::print_text(stderr, kaya::render(error) + "\n");
        return static_cast<int>(error.fault);
    } catch (const std::exception& error) {
        kaya::print_text(stderr, fmt::format("error: kaya itself failed: {}\n", error.what()));
        return static_cast<int>(kaya::Fault::own);
    }
}
