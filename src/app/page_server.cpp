#include "app/page_server.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <list>
#include <mutex>
#include <poll.h>
#include <pthread.h>
#include <sstream>
#include <sys/random.h>
#include <sys/socket.h>
#include <thread>
#include <vector>

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
using SteadyClock = std::chrono::steady_clock;

namespace {

// Limits of one connection. A browser needs a few connections at a time.
constexpr std::size_t most_connections = 32;
constexpr std::size_t longest_head = 8192;
constexpr std::chrono::seconds head_time{2};    ///< from the first moment to the end of its request
constexpr std::chrono::seconds silence_time{5}; ///< without taking a byte of its answer
constexpr std::chrono::seconds answer_time{60}; ///< to the last byte of it
constexpr int tick = 100;                       ///< milliseconds after which limits are looked at

} // namespace

struct PageServer::Server {
    /// Serves one request and is closed. No call on its socket blocks.
    struct Connection {
        tcp::socket socket;
        std::string head;                        ///< of the request, as far as it has come
        std::string answer;                      ///< the head of the answer; empty: the request is not whole
        std::shared_ptr<const std::string> body; ///< that follows
        std::size_t sent = 0;                    ///< of both
        SteadyClock::time_point began = SteadyClock::now();
        SteadyClock::time_point last = began; ///< when a byte went either way

        explicit Connection(tcp::socket accepted) : socket(std::move(accepted)) {}

        bool is_asking() const { return answer.empty(); }
        bool is_late(SteadyClock::time_point now) const {
            return is_asking() ? now - began > head_time : now - last > silence_time || now - began > answer_time;
        }
        std::string_view left() const {
            return sent < answer.size() ? std::string_view(answer).substr(sent)
                                        : std::string_view(*body).substr(sent - answer.size());
        }
        /// False when the other side has closed, or the request is too long.
        bool read() {
            std::array<char, 2048> part{};
            const auto size = ::recv(socket.native_handle(), part.data(), part.size(), MSG_DONTWAIT);
            if (size < 0) return errno == EAGAIN || errno == EINTR;
            head.append(part.data(), static_cast<std::size_t>(size));
            last = SteadyClock::now();
            return size > 0 && head.size() <= longest_head;
        }
        /// False when all is sent, or the other side has closed.
        bool write() {
            const auto text = left();
            const auto size = ::send(socket.native_handle(), text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
            if (size < 0) return errno == EAGAIN || errno == EINTR;
            sent += static_cast<std::size_t>(size);
            last = SteadyClock::now();
            return sent < answer.size() + body->size();
        }
    };

    boost::asio::io_context context;
    tcp::acceptor acceptor{context};
    std::string path; ///< "/0f3a.../"
    std::thread thread;
    std::list<Connection> connections; ///< of the thread
    std::atomic<bool> ends = false;
    std::atomic<std::int64_t> asked = 0; ///< seconds of the steady clock
    std::mutex mutex;                    ///< of the page and its version
    std::shared_ptr<const std::string> page = std::make_shared<std::string>(
        "<!DOCTYPE html><title>kaya</title><meta http-equiv=\"refresh\" content=\"2\"><p>The run has not begun to cycle yet.</p>");
    int version = 0;

    static std::int64_t now() {
        return std::chrono::duration_cast<std::chrono::seconds>(SteadyClock::now().time_since_epoch()).count();
    }

    /// Fills in the answer.
    void answer(Connection& to, const http::request<http::empty_body>& request) {
        http::response<http::empty_body> response(http::status::ok, request.version());
        response.set(http::field::cache_control, "no-store");
        response.set(http::field::content_type, "text/plain");
        to.body = std::make_shared<std::string>();
        if (request.method() != http::verb::get) response.result(http::status::method_not_allowed);
        else if (request.target() == path || request.target() == path + "version") {
            asked = now();
            const std::lock_guard lock(mutex);
            const bool whole = request.target() == path;
            if (whole) response.set(http::field::content_type, "text/html; charset=utf-8");
            to.body = whole ? page : std::make_shared<const std::string>(std::to_string(version));
        } else response.result(http::status::not_found);
        response.keep_alive(false);
        response.content_length(to.body->size());
        std::ostringstream text;
        text << response.base();
        to.answer = text.str();
    }

    /// False when the connection can be closed.
    bool advance(Connection& one, short ready) {
        if (!one.is_asking()) return (ready & (POLLOUT | POLLERR | POLLHUP)) == 0 || one.write();
        if (ready == 0) return true;
        if (!one.read()) return false;
        if (one.head.find("\r\n\r\n") == std::string::npos) return true;
        http::request_parser<http::empty_body> parser;
        boost::system::error_code problem;
        parser.put(boost::asio::buffer(one.head), problem);
        if (problem || !parser.is_header_done()) return false;
        answer(one, parser.get());
        return true;
    }

    /// Replaces the connection that was idle longest if there are too many.
    void accept() {
        if (connections.size() >= most_connections)
            connections.erase(std::ranges::min_element(connections, {}, &Connection::last));
        boost::system::error_code problem;
        tcp::socket socket(context);
        acceptor.accept(socket, problem);
        if (!problem) connections.emplace_back(std::move(socket));
        else if (problem != boost::asio::error::would_block) // as a rule the process has too many open files
            std::this_thread::sleep_for(std::chrono::milliseconds(tick));
    }

    void serve() {
        std::vector<pollfd> sockets;
        while (!ends) {
            sockets.assign(1, {acceptor.native_handle(), POLLIN, 0});
            for (auto& one : connections)
                sockets.push_back(
                    {one.socket.native_handle(), static_cast<short>(one.is_asking() ? POLLIN : POLLOUT), 0});
            if (::poll(sockets.data(), sockets.size(), tick) < 0) continue;
            const auto time = SteadyClock::now();
            auto socket = sockets.begin() + 1;
            for (auto one = connections.begin(); one != connections.end(); ++socket)
                one = advance(*one, socket->revents) && !one->is_late(time) ? std::next(one) : connections.erase(one);
            if (sockets.front().revents != 0) accept();
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
    if (!problem) own.acceptor.listen(static_cast<int>(most_connections), problem);
    if (!problem) own.acceptor.non_blocking(true, problem);
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
    ::shutdown(server_->acceptor.native_handle(), SHUT_RDWR); // the thread need not wait for its tick
    server_->thread.join();
}

void PageServer::show(std::string page) {
    const std::lock_guard lock(server_->mutex);
    std::string script = reload_script;
    script.replace(script.find('@'), 1, std::to_string(++server_->version));
    if (const auto end = page.rfind("</body>"); end != std::string::npos) page.insert(end, script);
    server_->page = std::make_shared<const std::string>(std::move(page));
}

bool PageServer::is_read() const { return Server::now() - server_->asked < lately.count(); }

} // namespace kaya
