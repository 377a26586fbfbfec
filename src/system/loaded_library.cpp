#include "system/loaded_library.hpp"

#include "system/crash_report.hpp"
#include "system/run_record.hpp"

#include <dlfcn.h>
#include <mutex>

namespace kaya {

namespace {

/// Outlives all exits.
std::recursive_mutex*& mutex_of_loading() {
    static auto* mutex = new std::recursive_mutex;
    return mutex;
}

std::recursive_mutex& of_loading() { return *mutex_of_loading(); }

} // namespace

LoadingHeld::LoadingHeld() {
    of_loading().lock();
    hold_names();
}

LoadingHeld::~LoadingHeld() {
    release_names();
    of_loading().unlock();
}

void LoadingHeld::forked() {
    release_names();
    // The other one belongs to a thread of the first process, and exit() in a library unloads the others.
    mutex_of_loading() = new std::recursive_mutex;
}

std::shared_ptr<void> load_library(const std::filesystem::path& name, const Called* who, std::string& fault) {
    const std::lock_guard guard(of_loading());
    // Local symbols keep models apart.
    void* const handle = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        fault = ::dlerror();
        return nullptr;
    }
    return {handle, [who](void* library) {
                const std::lock_guard held(of_loading());
                const AtWork unloading(who, "unloading");
                ::dlclose(library);
            }};
}

void* symbol_of(void* library, const char* symbol) { return ::dlsym(library, symbol); }

void keep_loaded(const std::filesystem::path& name) { ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE); }

std::filesystem::path file_of_code(const void* place) {
    Dl_info info{};
    return ::dladdr(place, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

} // namespace kaya
