#include "model/state_hash.hpp"

namespace kaya {

std::uint64_t state_hash(Model& model) {
    HashArchive archive;
    visit_state(archive, model);
    return archive.digest();
}

} // namespace kaya
