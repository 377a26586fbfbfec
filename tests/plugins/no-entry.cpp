// A shared library, but not a joint model.
extern "C" __attribute__((visibility("default"))) int answer() { return 42; }
