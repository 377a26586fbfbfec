/* SPDX-License-Identifier: MIT
 *
 * kaya as a library: models that another program builds, runs and reads. Link with -lkaya. docs/library.md.
 *
 * Words, units and files are those of decks; nothing is converted. Different models may run in different threads at once; one
 * model belongs to one thread at a time, except for kaya_interrupt. Pointers that a model gives are valid until the next call with it.
 */
#ifndef KAYA_KAYA_H
#define KAYA_KAYA_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. A library refuses options of another one. */
#define KAYA_LIBRARY_INTERFACE 1

typedef struct kaya_model kaya_model;

/* The exit status that the program would have. */
typedef enum kaya_status {
    KAYA_DONE = 0,
    KAYA_WRONG = 1,  /* the commands, or the arguments of a call, are wrong */
    KAYA_FAILED = 2, /* the run failed, or was interrupted */
    KAYA_FAULT = 3   /* a fault of kaya, or no memory */
} kaya_status;

/* Receives text of `size` bytes, mostly whole lines; there is no 0 at the end. */
typedef void (*kaya_writer)(void* user, const char* text, size_t size);

/* Set all to zero, then `interface` and what is wanted. */
typedef struct kaya_options {
    int interface; /* KAYA_LIBRARY_INTERFACE */
    int strict;    /* not 0: warnings are errors */
    int trust;     /* not 0: scripts may use files and other programs */
    const char*
        joints; /* folder of joint models, with the folder of zone models next to it; NULL: those installed with the library */
    kaya_writer output;   /* what commands print; NULL: not kept */
    kaya_writer messages; /* notes and warnings; NULL: not kept */
    void* user;           /* first argument of both */
} kaya_options;

/* One mistake. Texts are UTF-8, never NULL; "" where there is nothing to say. */
typedef struct kaya_error {
    kaya_status status;
    const char* message; /* a sentence */
    const char* hint;    /* what to do */
    const char* file;    /* "" where there is no place */
    int line, column;    /* from 1; 0 where there is no place */
    const char* text;    /* all of it as the program shows it, with the line and its underline */
} kaya_error;

typedef enum kaya_type {
    KAYA_FLOAT64 = 0, /* double */
    KAYA_INT64 = 1,   /* int64_t; of a link to another object: its row, -1 for none */
    KAYA_TEXT = 2     /* const char* */
} kaya_type;

/* `rows` times `each` values, row by row: `each` is 3 for vectors, otherwise 1. */
typedef struct kaya_span {
    kaya_type type;
    size_t rows, each;
    const void* values;
} kaya_span;

/* "0.2.0" */
const char* kaya_version(void);

/* An empty model. Returns KAYA_WRONG for options of another interface, KAYA_FAULT without memory; *model is then NULL. */
kaya_status kaya_open(const kaya_options* options, kaya_model** model);
/* Ends it; NULL is allowed. */
void kaya_close(kaya_model* model);

/* Runs commands, one to a line; `name` is what errors call this text. */
kaya_status kaya_run(kaya_model* model, const char* commands, const char* name);
/* Runs a deck. */
kaya_status kaya_run_file(kaya_model* model, const char* file);
/* Ends the running call after the present cycle, which then returns KAYA_FAILED. For any thread, and for signal handlers. */
void kaya_interrupt(kaya_model* model);

/* Calls `function` after each cycle whose number is a multiple of `interval`. It may read the model, not run commands. */
kaya_status kaya_after_cycles(kaya_model* model, int64_t interval, void (*function)(void* user, kaya_model* model),
                              void* user);

/* Mistakes of the last call: several where a deck has several. */
size_t kaya_error_count(const kaya_model* model);
kaya_error kaya_error_at(const kaya_model* model, size_t number);

/* A field of all objects of a kind: "block", "gridpoint", "zone", "contact", "sub_contact", ... docs/fields.md lists both; the classic
   and the modern names of FISH are understood too. Of the kind "model" there is one row. */
kaya_status kaya_field(kaya_model* model, const char* kind, const char* field, kaya_span* span);
/* Sets a field of one object from its `count` numbers. */
kaya_status kaya_set_field(kaya_model* model, const char* kind, const char* field, size_t row, const double* numbers,
                           size_t count);

/* The digest that the program prints at its end: equal states have equal digests. */
uint64_t kaya_hash(kaya_model* model);

#ifdef __cplusplus
}
#endif

#endif
