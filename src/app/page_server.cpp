#include "app/page_server.hpp"

#include "base/diagnostic.hpp"

#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <mutex>
#include <poll.h>
#include <pthread.h>
#include <sstream>
#include <sys/random.h>
#include <sys/socket.h>
#include <thread>

namespace kaya {

namespace {

constexpr const char* here = "127.0.0.1";
constexpr std::chrono::seconds lately{30};

/// 128 random bits.
std::string token() {
    std::array<unsigned char, 16> bytes{};
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw Diagnostic("this machine gives no random numbers", {}, Fault::run);
    std::string text;
    for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

/// Polls for a newer page and offers it; the present page stays until the user asks for the new one.
constexpr const char* reload_script =
    R"(<div id="newer" style="display:none;position:fixed;top:0;left:0;right:0;padding:.4em;text-align:center;background:#fd8;z-index:9">the run has gone on: <a href="">show it</a></div>
<script>setInterval(async () => {
    try {
        const now = await (await fetch('version')).text();
        if (now !== '@') document.getElementById('newer').style.display = 'block';
    } catch { document.getElementById('newer').style.display = 'block'; document.getElementById('newer').textContent = 'the run has ended'; }
}, 2000);</script>
)";

} // namespace

namespace http = boost::beast::http;
using tcp = boost::asio::ip::tcp;

struct PageServer::Server {
    boost::asio::io_context context;
    tcp::acceptor acceptor{context};
    std::string path; ///< "/0f3a.../"
    std::thread thread;
    std::atomic<bool> ends = false;
    std::atomic<std::int64_t> asked = 0; ///< seconds of the steady clock
    std::mutex mutex;                    ///< of the page and its version
    std::string page =
        "<!DOCTYPE html><title>kaya</title><meta http-equiv=\"refresh\" content=\"2\"><p>The run has not begun to cycle yet.</p>";
    int version = 0;

    static std::int64_t now() {
        return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now().time_since_epoch())
            .count();
    }

    http::response<http::string_body> answer(const http::request<http::empty_body>& request) {
        http::response<http::string_body> response(http::status::ok, request.version());
        response.set(http::field::cache_control, "no-store");
        response.set(http::field::content_type, "text/plain");
        if (request.method() != http::verb::get) response.result(http::status::method_not_allowed);
        else if (request.target() == path || request.target() == path + "version") {
            asked = now();
            const std::lock_guard lock(mutex);
            const bool whole = request.target() == path;
            if (whole) response.set(http::field::content_type, "text/html; charset=utf-8");
            response.body() = whole ? page : std::to_string(version);
        } else response.result(http::status::not_found);
        response.keep_alive(false);
        response.prepare_payload();
        return response;
    }

    /// Until the socket is ready. False when it is not in time, or the run ends.
    bool ready(int socket, short what, std::chrono::steady_clock::time_point until) const {
        while (!ends && std::chrono::steady_clock::now() < until) {
            pollfd asked_for{socket, what, 0};
            if (::poll(&asked_for, 1, 100) > 0) return true;
        }
        return false;
    }

    /// The head of a request as far as it was received; the rest is ignored.
    std::string read_head(int socket) const {
        constexpr std::size_t longest = 8192;
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(2);
        std::string text;
        std::array<char, 1024> part{};
        while (text.size() < longest && text.find("\r\n\r\n") == std::string::npos && ready(socket, POLLIN, until)) {
            const auto size = ::recv(socket, part.data(), part.size(), 0);
            if (size <= 0) break;
            text.append(part.data(), static_cast<std::size_t>(size));
        }
        return text;
    }

    void write(int socket, std::string_view text) const {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (!text.empty() && ready(socket, POLLOUT, until)) {
            const auto size = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
            if (size < 0) return;
            text.remove_prefix(static_cast<std::size_t>(size));
        }
    }

    /// Serves one connection at a time; idle ones are dropped.
    void serve() {
        while (!ends) {
            boost::system::error_code problem;
            tcp::socket socket(context);
            acceptor.accept(socket, problem);
            if (problem) continue;
            const std::string head = read_head(socket.native_handle());
            http::request_parser<http::empty_body> parser;
            parser.put(boost::asio::buffer(head), problem);
            if (problem || !parser.is_header_done()) continue;
            std::ostringstream text;
            text << answer(parser.get());
            write(socket.native_handle(), text.view());
        }
    }
};

PageServer::PageServer(int port) : server_(std::make_unique<Server>()) {
    Server& own = *server_;
    own.path = fmt::format("/{}/", token());
    own.asked = Server::now(); // the first page is wanted
    boost::system::error_code problem;
    const tcp::endpoint place(boost::asio::ip::make_address_v4(here), static_cast<unsigned short>(port));
    own.acceptor.open(place.protocol(), problem);
    if (!problem) own.acceptor.set_option(tcp::acceptor::reuse_address(true), problem);
    if (!problem) own.acceptor.bind(place, problem);
    if (!problem) own.acceptor.listen(8, problem);
    if (problem)
        throw Diagnostic(fmt::format("port {} cannot be used: {}", port, problem.message()),
                         "another program has it, or it is below 1024: --watch 0 takes any that is free", Fault::run);
    address_ = fmt::format("http://{}:{}{}", here, own.acceptor.local_endpoint().port(), own.path);
    // Signals are for the run, and so is a reader that goes away in the middle of a page.
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before);
    own.thread = std::thread([&own] { own.serve(); });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

PageServer::~PageServer() {
    server_->ends = true;
    ::shutdown(server_->acceptor.native_handle(), SHUT_RDWR); // a call that waits for a connection returns
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
