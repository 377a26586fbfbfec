// Simulates a kernel or file system without a feature: from now on a system call of this process fails.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace kaya::test {

/// The call fails with the error if one of `bits` is set in its argument of that number; with bits 0, always. It cannot be undone: for a
/// child process.
inline void refuse_call(long call, int error, unsigned argument = 0, std::uint32_t bits = 0) {
    const auto offset = static_cast<std::uint32_t>(offsetof(seccomp_data, args) + 8 * argument);
    sock_filter filter[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, static_cast<std::uint8_t>(bits == 0 ? 0 : 1)),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error)),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog program{sizeof filter / sizeof *filter, filter};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
        throw std::runtime_error("cannot refuse a system call");
}

} // namespace kaya::test
