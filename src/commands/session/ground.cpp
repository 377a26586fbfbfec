#include "commands/session/ground.hpp"
namespace kaya {

Ground ground_of(Session& session, const std::string& file, const Vec3& shift, const Place& place) {
    try {
        Ground ground = read_ground(session.input_file(file).string());
        if (!shift.isZero()) ground.move(shift);
        return ground;
    } catch (Diagnostic& mistake) {
        mistake.at(place);
        throw;
    }
}

} // namespace kaya
