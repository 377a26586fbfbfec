// kaya: runs command files. Exit status 0 done, 1 the deck is wrong, 2 the run failed, 3 our own fault.
#include "app/parent.hpp"
#include "app/work.hpp"
#include "base/diagnostic.hpp"
#include "system/door.hpp"
#include "system/run_record.hpp"

#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <unistd.h>

namespace {

/// Otherwise the next opened file would become the standard output.
void open_missing_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && kaya::door::null_device().release() < 0)
            std::_Exit(static_cast<int>(kaya::Fault::run));
}

} // namespace

int main(int argc, char** argv) {
    open_missing_streams();
    return kaya::run_in_child([=] {
        const int status = kaya::work(argc, argv);
        std::fflush(stdout);
        kaya::note_end(status);
        return status;
    });
}
