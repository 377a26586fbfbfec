// Parallel loops whose result does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace kaya {

/// A reference to something callable with (first, last). It must outlive the call it is passed to;
/// unlike std::function it allocates nothing.
class ChunkBody {
public:
    template <class Body>
    requires(!std::is_same_v<std::remove_cvref_t<Body>, ChunkBody>)
        ChunkBody(Body&& body) // implicit on purpose: a lambda is written at the call
        : body_(const_cast<void*>(static_cast<const void*>(std::addressof(body)))),
          call_([](void* b, std::size_t first, std::size_t last) {
              (*static_cast<std::remove_reference_t<Body>*>(b))(first, last);
          }) {}

    void operator()(std::size_t first, std::size_t last) const { call_(body_, first, last); }

private:
    void* body_;
    void (*call_)(void*, std::size_t, std::size_t);
};

/// How many threads the loops below may use. Changing it changes no number, only the time.
void set_threads(int count);
int threads();

/// Calls body(first, last) for consecutive chunks of [0, n). The chunks depend on n and grain only,
/// never on the number of threads, and body must write only to the rows of its chunk.
/// An exception from body is rethrown here after the loop has ended (the one of the lowest chunk).
void for_chunks(std::size_t n, std::size_t grain, ChunkBody body);

} // namespace kaya
