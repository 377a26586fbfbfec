// `kaya --watch PORT`: the growing report of a run, for a browser on this machine.
#pragma once

#include <memory>
#include <string>

namespace kaya {

/// Listens on the loopback address only, answers GET only, and only under an unguessable address. The page is the last one given. Serves 32
/// connections at a time; a slow or idle one delays no other and is closed after some seconds. It has its own thread; the run does not wait for it.
class PageServer {
public:
    /// Port 0: any free one. Throws Diagnostic when the port is taken.
    explicit PageServer(int port);
    ~PageServer();
    PageServer(const PageServer&) = delete;
    PageServer& operator=(const PageServer&) = delete;

    /// "http://127.0.0.1:8080/0f3a.../"
    const std::string& address() const { return address_; }
    void show(std::string page);
    /// Whether a page was requested lately; if not, the run need not make one.
    bool is_read() const;

private:
    struct Server;
    std::unique_ptr<Server> server_;
    std::string address_;
};

} // namespace kaya
