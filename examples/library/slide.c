/* A block rests on a plane of 40 degrees; with a friction of 30 it slides: after 0.2 s at g t (sin 40 - cos 40 tan 30) = 0.393 m/s. */
#include <kaya/kaya.h>
#include <stdio.h>

static void print(void* file, const char* text, size_t size) { fwrite(text, 1, size, (FILE*)file); }

int main(void) {
    const char* commands = "poly brick -2 4 0 1 -1 0\n"
                           "poly brick 0 1 0 1 0 1\n"
                           "prop mat 1 dens 2000\n"
                           "jmodel model mohr\n"
                           "prop jmat 1 jkn 1e9 jks 1e9 jfric 60\n"
                           "fix range z -1 0\n"
                           "gravity 6.3058 0 -7.5149\n" /* 9.81 m/s2, turned by 40 degrees */
                           "solve\n"
                           "prop jmat 1 jfric 30\n"
                           "damp none\n"
                           "cycle time 0.2\n";
    kaya_options options = {.interface = KAYA_LIBRARY_INTERFACE, .messages = print, .user = stderr};
    kaya_model* model;
    if (kaya_open(&options, &model) != KAYA_DONE) return 1;
    kaya_status status = kaya_run(model, commands, "slide");
    if (status != KAYA_DONE) {
        fprintf(stderr, "%s\n", kaya_error_at(model, 0).text);
        kaya_close(model);
        return status;
    }
    kaya_span velocity;
    if (kaya_field(model, "block", "velocity", &velocity) == KAYA_DONE) {
        const double* v = velocity.values;
        for (size_t row = 0; row < velocity.rows; ++row, v += 3) printf("block %zu: %.3f %.3f %.3f m/s\n", row + 1, v[0], v[1], v[2]);
    }
    kaya_close(model);
    return 0;
}
