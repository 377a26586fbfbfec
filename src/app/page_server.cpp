#include "app/page_server.hpp"

#include "base/diagnostic.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <httplib.h>
#include <mutex>
#include <pthread.h>
#include <sys/random.h>
#include <thread>

namespace kaya {

namespace {

constexpr const char* here = "127.0.0.1";
constexpr std::chrono::seconds lately{30};

/// 128 bits that nobody can guess.
std::string token() {
    std::array<unsigned char, 16> bytes{};
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) throw Diagnostic("this machine gives no random numbers", {}, Fault::run);
    std::string text;
    for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

/// Asks for a newer page now and then, and offers it; what is looked at stays until somebody wants to see more.
constexpr const char* reload_script = R"(<div id="newer" style="display:none;position:fixed;top:0;left:0;right:0;padding:.4em;text-align:center;background:#fd8;z-index:9">the run has gone on: <a href="">show it</a></div>
<script>setInterval(async () => {
    try {
        const now = await (await fetch('version')).text();
        if (now !== '@') document.getElementById('newer').style.display = 'block';
    } catch { document.getElementById('newer').style.display = 'block'; document.getElementById('newer').textContent = 'the run has ended'; }
}, 2000);</script>
)";

} // namespace

struct PageServer::Server {
    httplib::Server http;
    std::thread thread;
    std::mutex mutex;
    std::string page = "<!DOCTYPE html><title>kaya</title><meta http-equiv=\"refresh\" content=\"2\"><p>The run has not begun to cycle yet.</p>"; ///< by the mutex, as its version
    int version = 0;
    std::atomic<std::int64_t> asked = 0; ///< seconds of the steady clock

    static std::int64_t now() { return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
};

PageServer::PageServer(int port) : server_(std::make_unique<Server>()) {
    Server& own = *server_;
    const std::string path = fmt::format("/{}/", token());
    own.asked = Server::now(); // the first page is wanted
    own.http.Get(path, [&own](const httplib::Request&, httplib::Response& response) {
        own.asked = Server::now();
        const std::lock_guard lock(own.mutex);
        response.set_header("Cache-Control", "no-store");
        response.set_content(own.page, "text/html; charset=utf-8");
    });
    own.http.Get(path + "version", [&own](const httplib::Request&, httplib::Response& response) {
        own.asked = Server::now();
        const std::lock_guard lock(own.mutex);
        response.set_header("Cache-Control", "no-store");
        response.set_content(fmt::format("{}", own.version), "text/plain");
    });
    own.http.set_payload_max_length(1024);
    // A port belongs to one run: the library would let two share it.
    own.http.set_socket_options([](socket_t socket) {
        const int yes = 1;
        ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    own.http.new_task_queue = [] { return new httplib::ThreadPool(2); };
    const bool bound = port == 0 ? (port = own.http.bind_to_any_port(here)) > 0 : own.http.bind_to_port(here, port);
    if (!bound) throw Diagnostic(fmt::format("port {} cannot be used", port), "another program has it, or it is below 1024: --watch 0 takes any that is free", Fault::run);
    address_ = fmt::format("http://{}:{}{}", here, port, path);
    // Signals are for the run.
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before);
    own.thread = std::thread([&own] { own.http.listen_after_bind(); });
    while (!own.http.is_running()) std::this_thread::yield();
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

PageServer::~PageServer() {
    server_->http.stop();
    server_->thread.join();
}

void PageServer::show(std::string page) {
    const std::lock_guard lock(server_->mutex);
    std::string script = reload_script;
    script.replace(script.find('@'), 1, std::to_string(++server_->version));
    const auto end = page.rfind("</body>");
    server_->page = std::move(page);
    if (end != std::string::npos) server_->page.insert(end, script);
}

bool PageServer::is_read() const { return Server::now() - server_->asked < lately.count(); }

} // namespace kaya
