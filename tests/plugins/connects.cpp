// Connects and listens by TCP, and fails with what became of that.
#include "tests/plugins/plugin.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <sys/socket.h>
#include <unistd.h>

namespace {

using Call = int (*)(int, const sockaddr*, socklen_t);

const char* outcome(Call call, int port) {
    const int number = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool refused =
        call(number, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 && errno == EACCES;
    close(number);
    return refused ? "refused" : "let through"; // also where another program has the port, or no program listens
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("connects");
    model.run = [](kaya_jbatch* batch) -> ptrdiff_t {
        constexpr int discard = 9, any_above_1024 = 47913;
        std::snprintf(batch->message, KAYA_JMODEL_MESSAGE, "connecting is %s, listening is %s",
                      outcome(connect, discard), outcome(bind, any_above_1024));
        return 0;
    };
    return &model;
}
