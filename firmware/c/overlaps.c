/* The pieces of memory of every function, two by two: whichever is written and shares a byte with
 * another one is refused, and nothing is written; pieces that touch are not refused. With an
 * argument, what is written is not compared, for tools that know which bytes stand for nothing.
 * Exit status 0 when all was answered as it should be. */

#include "cotama.h"
#include "cotama_robot.h"

#include <stdio.h>
#include <string.h>

enum { MOST = 8, SLOT = 4096, BEFORE = 1024, HANDLE = 8 };

/* Where the pieces of a call lie. */
typedef void *const places[MOST];

/* A piece of memory: `vital` bytes at its beginning say what the call needs to know. */
typedef struct {
  size_t bytes, align;
  bool written;
  size_t vital;
  void (*fill)(void *at, places at_all);
} piece;

typedef struct {
  const char *name;
  cotama_error (*with)(places at);
  piece pieces[MOST];
} call;

/* Pieces of one value of a type: for an answer, and given with what it says. */
#define ANSWER(TYPE) {sizeof(TYPE), _Alignof(TYPE), true, 0, NULL}
#define ANSWERS(TYPE, COUNT) {(COUNT) * sizeof(TYPE), _Alignof(TYPE), true, 0, NULL}
#define MEMORY(BYTES) {BYTES, 8, true, 0, NULL}
#define GIVEN(TYPE, FILL) {sizeof(TYPE), _Alignof(TYPE), false, sizeof(TYPE), FILL}
#define STARTED(BYTES, FILL) {BYTES, 8, true, HANDLE, FILL}

static void watchdog(void *at, places all) {
  (void)all;
  cotama_watchdog *handle;
  cotama_watchdog_start(at, COTAMA_WATCHDOG_BYTES, 0, &handle);
}
static void level(void *at, places all) {
  (void)all;
  cotama_level *handle;
  cotama_level_start(at, COTAMA_LEVEL_BYTES, COTAMA_ROBOT, &handle);
}
static void monitor(void *at, places all) {
  (void)all;
  static const uint64_t limits[] = {100, 200};
  static const uint32_t order[] = {0, 1};
  cotama_monitor *handle;
  cotama_monitor_start(at, COTAMA_MONITOR_BYTES, limits, order, &handle);
}
static void stored(void *at, places all) {
  uint64_t memory[COTAMA_WATCHDOG_BYTES / 8];
  watchdog(memory, all);
  cotama_watchdog_store((cotama_watchdog *)memory, at, COTAMA_WATCHDOG_STORED_BYTES, NULL);
}
static void stored_level(void *at, places all) {
  uint64_t memory[COTAMA_LEVEL_BYTES / 8];
  level(memory, all);
  cotama_level_store((cotama_level *)memory, at, COTAMA_LEVEL_STORED_BYTES, NULL);
}
/* The firings of a call are its last piece but one, their list is its last; so of failures. */
enum { FIRINGS = MOST - 2, LIST = MOST - 1, ROOM = 3 };
static void firings(void *at, places all) {
  const cotama_firings it = {all[LIST], ROOM, 0};
  memcpy(at, &it, offsetof(cotama_firings, count));
}
#define NOTED                                                                              \
  [FIRINGS] = {sizeof(cotama_firings), _Alignof(cotama_firings), true,                     \
               offsetof(cotama_firings, count), firings},                                  \
  [LIST] = ANSWERS(cotama_firing, ROOM)
#define FOUND                                                                              \
  [FIRINGS] = {sizeof(cotama_failures), _Alignof(cotama_failures), true,                   \
               offsetof(cotama_failures, count), failures},                                \
  [LIST] = ANSWERS(uint32_t, ROOM)
static void failures(void *at, places all) {
  const cotama_failures it = {all[LIST], ROOM, 0};
  memcpy(at, &it, offsetof(cotama_failures, count));
}
static void ticks(void *at, places all) {
  (void)all;
  memcpy(at, &(cotama_ticks){7}, sizeof(cotama_ticks));
}
static void seen(void *at, places all) {
  (void)all;
  memcpy(at, &(cotama_perceived){0, 0, COTAMA_MODULES_ALL}, sizeof(cotama_perceived));
}
static void drive(void *at, places all) {
  (void)all;
  memset(at, 1, sizeof(cotama_drive));
}
static void said(void *at, places all) {
  (void)all;
  memcpy(at, &(cotama_told){COTAMA_WORD_BEGINS, 0}, sizeof(cotama_told));
}
typedef uint64_t axes[COTAMA_AXES];
static void amounts(void *at, places all) {
  (void)all;
  memcpy(at, (const axes){50, 60}, sizeof(axes));
}
typedef uint32_t order[COTAMA_AXES];
static void in_order(void *at, places all) {
  (void)all;
  memcpy(at, (const order){1, 0}, sizeof(order));
}
/* A problem's candidates and counts lie where these pieces do. */
enum { CANDIDATES = 1, COUNTS = 2 };
typedef cotama_candidate three[3];
typedef uint32_t two[2];
static void problem(void *at, places all) {
  const cotama_problem it = {all[CANDIDATES], 3, all[COUNTS], 2, 0x11, {20, 20}, {0, 1}};
  memcpy(at, &it, sizeof it);
}
static void candidates(void *at, places all) {
  (void)all;
  memcpy(at, (const three){{0, {10, 10}, 1}, {1, {5, 5}, 0}, {0x10, {1, 1}, 9}}, sizeof(three));
}
static void counts(void *at, places all) {
  (void)all;
  memcpy(at, (const two){2, 1}, sizeof(two));
}
static void objectives(void *at, places all) {
  (void)all;
  memcpy(at, (const two){0, 1}, sizeof(two));
}
#define PROBLEM(BYTES)                                                                     \
  GIVEN(cotama_problem, problem), [CANDIDATES] = GIVEN(three, candidates),                 \
      [COUNTS] = GIVEN(two, counts), MEMORY(BYTES), ANSWERS(uint16_t, 2), ANSWER(cotama_answer)

/* A function with its arguments, as a row of the table below. */
#define CALLS(FUNCTION, ...) \
  static cotama_error with_##FUNCTION(places at) { return cotama_##FUNCTION(__VA_ARGS__); }
#define ROW(FUNCTION, ...) {"cotama_" #FUNCTION, with_##FUNCTION, {__VA_ARGS__}}

CALLS(flag_name, 0, at[0])
CALLS(module_name, 0, at[0])
CALLS(sub_objective_name, 0, at[0])
CALLS(configuration_name, 0, at[0])
CALLS(failure_name, 0, at[0])
CALLS(report_name, 0, at[0])
CALLS(loss_name, 0, at[0])
CALLS(watchdog_transition_name, 0, at[0])
CALLS(level_transition_names, 0, 0, at[0], at[1])
CALLS(ticks_widen, at[0], 9, at[1])
enum { LONGER = 16 }; /* all of the memory is the handle's, and not only what it needs */
CALLS(watchdog_start, at[0], COTAMA_WATCHDOG_BYTES + LONGER, 5, at[1])
CALLS(watchdog_offer, at[0], 5, COTAMA_WATCHDOG_EVENT_RELEASE, at[1], at[FIRINGS])
CALLS(watchdog_advance, at[0], 5, at[1], at[FIRINGS])
CALLS(watchdog_wake_at, at[0], at[1])
CALLS(watchdog_went_back, at[0], 5, at[1])
CALLS(watchdog_state, at[0], at[1])
CALLS(watchdog_tokens, at[0], COTAMA_WATCHDOG_PLACE_MISSES, at[1])
CALLS(watchdog_store, at[0], at[1], COTAMA_WATCHDOG_STORED_BYTES, at[2])
CALLS(watchdog_restore, at[0], COTAMA_WATCHDOG_BYTES + LONGER, 5, at[1],
      COTAMA_WATCHDOG_STORED_BYTES, at[2])
CALLS(level_start, at[0], COTAMA_LEVEL_BYTES + LONGER, COTAMA_ROBOT, at[1])
CALLS(level_perceive, at[0], 100, at[1], at[FIRINGS])
CALLS(level_report, at[0], COTAMA_FAILURE_PLN1)
CALLS(level_listens, at[0], at[1])
CALLS(level_round, at[0], 100, at[1], at[2], at[3], at[FIRINGS])
CALLS(level_requests, at[0], 100, at[1])
CALLS(level_store, at[0], at[1], COTAMA_LEVEL_STORED_BYTES, at[2])
CALLS(level_restore, at[0], COTAMA_LEVEL_BYTES + LONGER, COTAMA_ROBOT, 5, at[1],
      COTAMA_LEVEL_STORED_BYTES, at[2])
CALLS(plan_by_rule, at[0], at[3], COTAMA_RULE_BYTES(2, 3), at[4], 2, at[5])
CALLS(plan_exactly, at[0], at[6], 2, 1000, at[3], COTAMA_EXACT_BYTES(2, 3), at[4], 2, at[5])
CALLS(monitor_start, at[0], COTAMA_MONITOR_BYTES + LONGER, at[1], at[2], at[3])
CALLS(monitor_ask_upward, at[0], at[1], at[2])
CALLS(monitor_hardware_returned, at[0])
CALLS(monitor_planned, at[0], at[1])
CALLS(monitor_spend, at[0], at[1])
CALLS(monitor_left, at[0], at[1])
CALLS(monitor_margins, at[0], at[1], at[2])
CALLS(monitor_assess, at[0], at[1], 0, 0, at[2], at[3])

#define WATCHDOG STARTED(COTAMA_WATCHDOG_BYTES, watchdog)
#define LEVEL STARTED(COTAMA_LEVEL_BYTES, level)
#define MONITOR STARTED(COTAMA_MONITOR_BYTES, monitor)
static const call CALLED[] = {
    ROW(flag_name, ANSWER(cotama_text)),
    ROW(module_name, ANSWER(cotama_text)),
    ROW(sub_objective_name, ANSWER(cotama_text)),
    ROW(configuration_name, ANSWER(cotama_text)),
    ROW(failure_name, ANSWER(cotama_text)),
    ROW(report_name, ANSWER(cotama_text)),
    ROW(loss_name, ANSWER(cotama_text)),
    ROW(watchdog_transition_name, ANSWER(cotama_text)),
    ROW(level_transition_names, ANSWER(cotama_text), ANSWER(cotama_text)),
    ROW(ticks_widen,
        {sizeof(cotama_ticks), _Alignof(cotama_ticks), true, sizeof(cotama_ticks), ticks},
        ANSWER(uint64_t)),
    ROW(watchdog_start, MEMORY(COTAMA_WATCHDOG_BYTES + LONGER), ANSWER(cotama_watchdog *)),
    ROW(watchdog_offer, WATCHDOG, ANSWER(cotama_outcome), NOTED),
    ROW(watchdog_advance, WATCHDOG, ANSWER(bool), NOTED),
    ROW(watchdog_wake_at, WATCHDOG, ANSWER(uint64_t)),
    ROW(watchdog_went_back, WATCHDOG, ANSWER(uint64_t)),
    ROW(watchdog_state, WATCHDOG, ANSWER(uint32_t)),
    ROW(watchdog_tokens, WATCHDOG, ANSWER(uint32_t)),
    ROW(watchdog_store, WATCHDOG, ANSWERS(uint8_t, COTAMA_WATCHDOG_STORED_BYTES), ANSWER(size_t)),
    ROW(watchdog_restore, MEMORY(COTAMA_WATCHDOG_BYTES + LONGER),
        {COTAMA_WATCHDOG_STORED_BYTES, 1, false, COTAMA_WATCHDOG_STORED_BYTES, stored},
        ANSWER(cotama_watchdog *)),
    ROW(level_start, MEMORY(COTAMA_LEVEL_BYTES + LONGER), ANSWER(cotama_level *)),
    ROW(level_perceive, LEVEL, GIVEN(cotama_perceived, seen), FOUND),
    ROW(level_report, LEVEL),
    ROW(level_listens, LEVEL, ANSWER(bool)),
    ROW(level_round, LEVEL, GIVEN(cotama_told, said), GIVEN(cotama_drive, drive),
        ANSWER(cotama_round), NOTED),
    ROW(level_requests, LEVEL, ANSWER(cotama_requests)),
    ROW(level_store, LEVEL, ANSWERS(uint8_t, COTAMA_LEVEL_STORED_BYTES), ANSWER(size_t)),
    ROW(level_restore, MEMORY(COTAMA_LEVEL_BYTES + LONGER),
        {COTAMA_LEVEL_STORED_BYTES, 1, false, COTAMA_LEVEL_STORED_BYTES, stored_level},
        ANSWER(cotama_level *)),
    ROW(plan_by_rule, PROBLEM(COTAMA_RULE_BYTES(2, 3))),
    ROW(plan_exactly, PROBLEM(COTAMA_EXACT_BYTES(2, 3)), GIVEN(two, objectives)),
    ROW(monitor_start, MEMORY(COTAMA_MONITOR_BYTES + LONGER), GIVEN(axes, amounts),
        GIVEN(order, in_order), ANSWER(cotama_monitor *)),
    ROW(monitor_ask_upward, MONITOR, GIVEN(axes, amounts), GIVEN(axes, amounts)),
    ROW(monitor_hardware_returned, MONITOR),
    ROW(monitor_planned, MONITOR, GIVEN(axes, amounts)),
    ROW(monitor_spend, MONITOR, GIVEN(axes, amounts)),
    ROW(monitor_left, MONITOR, ANSWER(axes)),
    ROW(monitor_margins, MONITOR, GIVEN(axes, amounts), ANSWER(axes)),
    ROW(monitor_assess, MONITOR, GIVEN(axes, amounts), ANSWER(cotama_request), ANSWER(uint32_t)),
};

static _Alignas(64) unsigned char arena[MOST * SLOT], before[MOST * SLOT];
static bool compares = true;
static int failed, refused, answered;

/* Whether [a, a + m) and [b, b + n) share a byte. */
static bool share(const unsigned char *a, size_t m, const unsigned char *b, size_t n) {
  return m > 0 && n > 0 && a < b + n && b < a + m;
}

/* Makes a call whose pieces lie apart, but for number `other`, which lies `from` bytes behind the
 * beginning of number `one`. */
static void make(const call *it, size_t one, size_t other, ptrdiff_t from) {
  unsigned char *at[MOST];
  void *all[MOST];
  for (size_t piece = 0; piece < MOST; piece++) {
    at[piece] = arena + piece * SLOT + BEFORE;
  }
  if (one != other) {
    at[other] = at[one] + from;
  }
  for (size_t piece = 0; piece < MOST; piece++) {
    all[piece] = at[piece];
  }
  memset(arena, 0, sizeof arena);
  for (int handles = 1; handles >= 0; handles--) { /* first, as they fill more than is vital */
    for (size_t piece = 0; piece < MOST; piece++) {
      const bool handle = it->pieces[piece].vital < it->pieces[piece].bytes &&
                          it->pieces[piece].vital == HANDLE;
      if (it->pieces[piece].fill != NULL && handle == handles) {
        it->pieces[piece].fill(all[piece], all);
      }
    }
  }
  const piece a = it->pieces[one], b = it->pieces[other];
  const bool overlap = one != other && share(at[one], a.bytes, at[other], b.bytes);
  /* Where one has overwritten what is vital of the other, another error may be found first. */
  const bool destroyed = overlap && share(at[one], a.vital, at[other], b.vital);
  memcpy(before, arena, sizeof arena);
  const cotama_error answer = it->with(all);
  const bool right = !overlap ? answer == COTAMA_ERROR_OK
                              : answer == COTAMA_ERROR_OVERLAP ||
                                    (destroyed && answer != COTAMA_ERROR_OK);
  const bool untouched = !compares || memcmp(before, arena, sizeof arena) == 0;
  if (!right || (overlap && !untouched)) {
    printf("%s: piece %zu lies %td bytes behind the beginning of piece %zu: %s%s\n", it->name,
           other, from, one, cotama_error_text(answer), untouched ? "" : ", and it writes");
    failed++;
  }
  *(overlap ? &refused : &answered) += 1;
}

/* The largest multiple of an alignment up to a number. */
static ptrdiff_t down(ptrdiff_t number, size_t align) {
  return number - (number % (ptrdiff_t)align + (ptrdiff_t)align) % (ptrdiff_t)align;
}

int main(int count, char **arguments) {
  (void)arguments;
  compares = count == 1;
  for (size_t row = 0; row < sizeof CALLED / sizeof *CALLED; row++) {
    const call *it = &CALLED[row];
    make(it, 0, 0, 0);
    for (size_t one = 0; one < MOST; one++) {
      for (size_t other = 0; other < MOST; other++) {
        const piece a = it->pieces[one], b = it->pieces[other];
        if (one == other || a.bytes == 0 || b.bytes == 0 || !(a.written || b.written)) {
          continue;
        }
        const ptrdiff_t m = (ptrdiff_t)a.bytes, n = (ptrdiff_t)b.bytes;
        const ptrdiff_t ends = down(m - 1, b.align), begins = down(-n, b.align);
        const ptrdiff_t froms[] = {
            0, (ptrdiff_t)b.align, ends, down(m / 2, b.align), down(-n / 2, b.align),
            begins + (ptrdiff_t)b.align,
            /* and what only touches */
            ends + (ptrdiff_t)b.align, begins,
        };
        for (size_t from = 0; from < sizeof froms / sizeof *froms; from++) {
          make(it, one, other, froms[from]);
        }
      }
    }
  }
  printf("%d overlaps of %zu functions refused, %d calls with pieces apart answered, %d wrong\n",
         refused, sizeof CALLED / sizeof *CALLED, answered, failed);
  return failed == 0 ? 0 : 1;
}
