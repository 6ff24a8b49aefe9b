/* A supervisor, the decisional level, the allocator and the monitor of margins in C. The program of
 * the same steps in Rust, which calls no C, is examples/same_steps.rs: both print the same text. */

#include "cotama.h"
#include "cotama_robot.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

/* Whatever goes wrong here is a mistake of this program. */
static void must(cotama_error error) {
  if (error != COTAMA_ERROR_OK) {
    fprintf(stderr, "refused: %s\n", cotama_error_text(error));
    exit(EXIT_FAILURE);
  }
}

/* A watchdog of a module. */

enum { ROOM = 32 };

static const char *const OUTCOMES[] = {"fired",    "ignored on purpose", "not enabled",
                                       "too early", "too late",          "full",
                                       "behind",   "refused"};

static void print_firings(const cotama_firings *firings) {
  for (size_t at = 0; at < firings->count && at < firings->room; at++) {
    const cotama_firing it = firings->list[at];
    cotama_text name;
    must(cotama_watchdog_transition_name(it.transition, &name));
    printf("  %" PRIu64 " ms %.*s", it.at_ms, (int)name.length, name.bytes);
    if (it.outputs & 1u << COTAMA_WATCHDOG_OUTPUT_SKIP_JOB) {
      printf(" SkipJob");
    }
    if (it.outputs & 1u << COTAMA_WATCHDOG_OUTPUT_RT_FAULT) {
      printf(" RtFault");
    }
    printf("\n");
  }
}

static void print_watchdog(const cotama_watchdog *watchdog) {
  uint32_t place, misses;
  uint64_t wake;
  must(cotama_watchdog_state(watchdog, &place));
  must(cotama_watchdog_tokens(watchdog, COTAMA_WATCHDOG_PLACE_MISSES, &misses));
  must(cotama_watchdog_wake_at(watchdog, &wake));
  printf("  state %" PRIu32 ", misses %" PRIu32 ", wakes ", place, misses);
  if (wake == COTAMA_NEVER) {
    printf("never\n");
  } else {
    printf("at %" PRIu64 " ms\n", wake);
  }
}

static void watchdog_steps(void) {
  static const struct {
    uint64_t at_ms;
    uint32_t event;
  } TABLE[] = {
      {0, COTAMA_WATCHDOG_EVENT_RELEASE},   {40, COTAMA_WATCHDOG_EVENT_DONE},
      {100, COTAMA_WATCHDOG_EVENT_RELEASE}, {210, COTAMA_WATCHDOG_EVENT_DONE},
      {300, COTAMA_WATCHDOG_EVENT_RELEASE}, {350, COTAMA_WATCHDOG_EVENT_RELEASE},
      {500, COTAMA_WATCHDOG_EVENT_DONE},    {600, COTAMA_WATCHDOG_EVENT_RELEASE},
      {900, COTAMA_WATCHDOG_EVENT_CS_ACK},  {1000, COTAMA_WATCHDOG_EVENT_RELEASE},
      {1030, COTAMA_WATCHDOG_EVENT_DONE},
  };
  uint64_t memory[COTAMA_WATCHDOG_BYTES / 8];
  cotama_firing list[ROOM];
  cotama_firings firings = {list, ROOM, 0};
  cotama_watchdog *watchdog;
  must(cotama_watchdog_start(memory, sizeof memory, 0, &watchdog));
  for (size_t at = 0; at < sizeof TABLE / sizeof *TABLE; at++) {
    cotama_outcome outcome;
    must(cotama_watchdog_offer(watchdog, TABLE[at].at_ms, TABLE[at].event, &outcome, &firings));
    printf("%" PRIu64 " ms: event %" PRIu32 " %s\n", TABLE[at].at_ms, TABLE[at].event,
           OUTCOMES[outcome]);
    print_firings(&firings);
    print_watchdog(watchdog);
  }

  /* The power goes 60 ms after a release, and is back after four seconds. */
  must(cotama_watchdog_offer(watchdog, 1100, COTAMA_WATCHDOG_EVENT_RELEASE, NULL, NULL));
  must(cotama_watchdog_advance(watchdog, 1160, NULL, NULL));
  uint8_t flash[COTAMA_WATCHDOG_STORED_BYTES];
  size_t written;
  must(cotama_watchdog_store(watchdog, flash, sizeof flash, &written));
  printf("stored %zu bytes:", written);
  for (size_t at = 0; at < written; at++) {
    printf(" %02x", flash[at]);
  }
  printf("\n");
  must(cotama_watchdog_restore(memory, sizeof memory, 5160, flash, sizeof flash, &watchdog));
  print_watchdog(watchdog);
  bool behind;
  must(cotama_watchdog_advance(watchdog, 9000, &behind, &firings));
  printf("%s\n", behind ? "behind" : "not behind");
  print_firings(&firings);
  print_watchdog(watchdog);
}

/* A counter of milliseconds of 32 bits begins anew 60 ms after a release: the deadline stays. */
static void ticks_steps(void) {
  static const uint32_t COUNTS[] = {UINT32_MAX - 59, UINT32_MAX, 0, 39, UINT32_MAX, 40, 60, 1000};
  uint64_t memory[COTAMA_WATCHDOG_BYTES / 8];
  cotama_firing list[ROOM];
  cotama_firings firings = {list, ROOM, 0};
  cotama_ticks ticks = {COUNTS[0]};
  cotama_watchdog *watchdog;
  must(cotama_watchdog_start(memory, sizeof memory, ticks.latest_ms, &watchdog));
  must(cotama_watchdog_offer(watchdog, ticks.latest_ms, COTAMA_WATCHDOG_EVENT_RELEASE, NULL, NULL));
  for (size_t at = 0; at < sizeof COUNTS / sizeof *COUNTS; at++) {
    uint64_t now, back;
    must(cotama_ticks_widen(&ticks, COUNTS[at], &now));
    must(cotama_watchdog_went_back(watchdog, now, &back));
    printf("count %" PRIu32 " at %" PRIu64 " ms, back by %" PRIu64 " ms\n", COUNTS[at], now, back);
    must(cotama_watchdog_advance(watchdog, now, NULL, &firings));
    print_firings(&firings);
  }
  print_watchdog(watchdog);
}

/* The decisional level. */

static uint64_t flag(uint32_t it) { return UINT64_C(1) << it; }

/* Prints a name, which a function tells by a number. */
static void print_name(cotama_error (*tell)(uint32_t number, cotama_text *name), uint32_t number) {
  cotama_text name;
  must(tell(number, &name));
  printf(" %.*s", (int)name.length, name.bytes);
}

static void print_told(const cotama_told *told) {
  static const char *const WORDS[] = {"nothing", "begins", "over",    "stopped", "reached",
                                      "report",  "back",   "chooses", "done",    "gives up"};
  if (told->word == COTAMA_WORD_NOTHING) {
    return;
  }
  printf("  told %s", WORDS[told->word]);
  switch (told->word) {
    case COTAMA_WORD_OVER: printf(" %" PRIu32, told->number); break;
    case COTAMA_WORD_REACHED:
    case COTAMA_WORD_CHOOSES:
    case COTAMA_WORD_DONE: print_name(cotama_sub_objective_name, told->number); break;
    case COTAMA_WORD_REPORT: print_name(cotama_report_name, told->number); break;
    case COTAMA_WORD_BACK: print_name(cotama_loss_name, told->number); break;
    default: break;
  }
  printf("\n");
}

/* A set in print: the names of its members. */
static void print_set(const char *of, uint64_t set,
                      cotama_error (*tell)(uint32_t number, cotama_text *name)) {
  if (set == 0) {
    return;
  }
  printf("  %s", of);
  for (uint32_t number = 0; number < 64; number++) {
    if (set >> number & 1) {
      print_name(tell, number);
    }
  }
  printf("\n");
}

/* A period of the level. */
static void period(cotama_level *level, uint64_t now, const cotama_perceived *seen,
                   const cotama_told *said, const cotama_drive *drive) {
  cotama_firing list[ROOM];
  cotama_firings firings = {list, ROOM, 0};
  uint32_t found[4];
  cotama_failures failures = {found, sizeof found / sizeof *found, 0};
  printf("%" PRIu64 " ms\n", now);
  must(cotama_level_perceive(level, now, seen, &failures));
  if (failures.count > 0) {
    printf("  found %zu:", failures.count);
    for (size_t at = 0; at < failures.count && at < failures.room; at++) {
      print_name(cotama_failure_name, found[at]);
    }
    printf("\n");
  }
  bool listens;
  must(cotama_level_listens(level, &listens));
  if (!listens) {
    printf("  reports go first\n");
  }
  cotama_round round;
  must(cotama_level_round(level, now, said, drive, &round, &firings));
  print_told(&round.told);
  for (size_t at = 0; at < firings.count && at < firings.room; at++) {
    const cotama_firing it = list[at];
    cotama_text net, name;
    must(cotama_level_transition_names(it.net, it.transition, &net, &name));
    printf("  %.*s.%.*s says %#" PRIx64 "\n", (int)net.length, net.bytes, (int)name.length,
           name.bytes, it.outputs);
  }
  print_set("starts anew:", round.restarts, cotama_module_name);
  cotama_requests requests;
  must(cotama_level_requests(level, now, &requests));
  printf("  runs");
  if (requests.configuration == COTAMA_NONE) {
    printf(" nothing");
  } else {
    print_name(cotama_configuration_name, requests.configuration);
  }
  printf(",%s%s%s%s %" PRIu64 " mm/s\n", requests.drive ? " drive" : "",
         requests.halt ? " halt" : "", requests.ask ? " ask" : "", requests.alarm ? " alarm" : "",
         requests.speed_mm_s);
  print_set("settings:", requests.settings, cotama_report_name);
}

static void level_steps(void) {
  static uint64_t memory[COTAMA_LEVEL_BYTES / 8];
  static const cotama_told BEGINS = {COTAMA_WORD_BEGINS, 0},
                           RECEIVED = {COTAMA_WORD_OVER, COTAMA_STEP_RECEIVE},
                           DELIVERED = {COTAMA_WORD_OVER, COTAMA_STEP_DELIVER},
                           PLANNED = {COTAMA_WORD_REACHED, COTAMA_SUB_OBJECTIVE_PLANNING},
                           HELPS = {COTAMA_WORD_CHOOSES, COTAMA_SUB_OBJECTIVE_TELEOPERATION},
                           HELPED = {COTAMA_WORD_DONE, COTAMA_SUB_OBJECTIVE_TELEOPERATION};
  cotama_level *level;
  must(cotama_level_start(memory, sizeof memory, COTAMA_ROBOT, &level));
  for (uint64_t now = 0; now <= 4000; now += 100) {
    cotama_perceived seen = {0, 0, COTAMA_MODULES_ALL};
    const cotama_drive drive = {now == 1000 || now == 3600, now <= 200 || now >= 1000};
    const cotama_told *said = NULL;
    switch (now) {
      case 0: said = &BEGINS; break;
      case 200: said = &PLANNED; break;
      case 700: seen.raised = flag(COTAMA_FLAG_MCL_LATE); break;
      case 1300: said = &RECEIVED; break;
      case 1500: said = &PLANNED; break;
      case 1800: seen.raised = flag(COTAMA_FLAG_SONAR_FAR); break;
      case 2500: seen.raised = flag(COTAMA_FLAG_BUMPER); break;
      case 2600: seen.lowered = flag(COTAMA_FLAG_BUMPER); break;
      case 2900: said = &HELPS; break;
      case 3300: said = &HELPED; break;
      case 3800: said = &DELIVERED; break;
      default: break;
    }
    period(level, now, &seen, said, &drive);
  }

  /* The power goes before another mission begins, and is back after two seconds; then no
   * plan is left. */
  must(cotama_level_start(memory, sizeof memory, COTAMA_ROBOT, &level));
  const cotama_drive drives = {0, 0};
  cotama_perceived seen = {flag(COTAMA_FLAG_MODULE_SILENT), 0, COTAMA_MODULES_ALL};
  period(level, 10000, &seen, &BEGINS, &drives);
  uint8_t flash[COTAMA_LEVEL_STORED_BYTES];
  size_t written;
  must(cotama_level_store(level, flash, sizeof flash, &written));
  printf("stored %zu bytes:", written);
  for (size_t at = 0; at < written; at++) {
    printf(" %02x", flash[at]);
  }
  printf("\n");
  must(cotama_level_restore(memory, sizeof memory, COTAMA_ROBOT, 12000, flash, sizeof flash,
                            &level));
  for (uint64_t now = 12000; now <= 12500; now += 100) {
    seen.raised = now == 12100 ? flag(COTAMA_FLAG_MODULE_SILENT) : 0;
    period(level, now, &seen, &BEGINS, &drives);
  }
  must(cotama_level_report(level, COTAMA_FAILURE_PLN1));
  period(level, 12600, &seen, NULL, &drives);
  period(level, 12700, &seen, NULL, &drives);
}

/* Allocation. */

enum { ACTIVITIES = 17, CANDIDATES = 21 };

/* Knuth's MMIX generator; the upper bits are the better ones. */
static uint64_t state = 1;
static uint32_t draw(uint32_t below) {
  state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (uint32_t)(state >> 33) % below;
}

static void print_answer(const char *by, const cotama_answer *answer, const uint16_t *chosen,
                         size_t activities) {
  printf("  %s: ", by);
  switch (answer->verdict) {
    case COTAMA_VERDICT_PLANNED:
      for (size_t at = 0; at < activities; at++) {
        printf("%u ", (unsigned)chosen[at]);
      }
      printf("costs %" PRIu64 " ms, %" PRIu64 " mJ, quality %" PRIu64 "%s", answer->cost[0],
             answer->cost[1], answer->quality, answer->optimal ? ", the best" : "");
      if (answer->bounded) {
        printf(", bound %" PRIu64, answer->bound);
      }
      break;
    case COTAMA_VERDICT_INFEASIBLE:
      printf("infeasible");
      if (answer->axis != COTAMA_NONE) {
        printf(", axis %" PRIu32 ": %" PRIu64 " of %" PRIu64, answer->axis, answer->least,
               answer->limit);
      }
      break;
    case COTAMA_VERDICT_OUT_OF_BUDGET:
      printf("out of budget, bound %" PRIu64, answer->bound);
      break;
    case COTAMA_VERDICT_WITHOUT_HARDWARE:
      printf("without hardware, activity %" PRIu32, answer->activity);
      break;
    default: printf("no such verdict"); break;
  }
  printf(", %" PRIu64 " steps\n", answer->steps);
}

static void allocation_steps(void) {
  static uint64_t memory[COTAMA_EXACT_BYTES(ACTIVITIES, ACTIVITIES *CANDIDATES) / 8];
  static cotama_candidate candidates[ACTIVITIES * CANDIDATES];
  static const uint32_t OBJECTIVES[] = {COTAMA_OBJECTIVE_MOST_QUALITY,
                                        COTAMA_OBJECTIVE_LEAST_ENERGY};
  uint32_t counts[ACTIVITIES];
  uint16_t chosen[ACTIVITIES];
  for (int number = 0; number < 100; number++) {
    const uint32_t activities = 1 + draw(ACTIVITIES);
    uint64_t most[COTAMA_AXES] = {0, 0};
    size_t filled = 0;
    for (uint32_t activity = 0; activity < activities; activity++) {
      counts[activity] = 1 + draw(CANDIDATES);
      most[0] += 30000;
      most[1] += 400000;
      for (uint32_t at = 0; at < counts[activity]; at++) {
        cotama_candidate *it = &candidates[filled++];
        it->cost[0] = 1000 + draw(50000);
        it->cost[1] = 10000 + draw(700000);
        it->quality = draw(100);
        it->units = UINT64_C(1) << 4 * draw(4);
      }
    }
    /* One draw after the other: C does not say in which order a list is evaluated. */
    const uint64_t available = draw(4) == 0 ? 0x0111 : 0x1111;
    const uint64_t duration_ms = most[0] * (40 + draw(60)) / 100;
    const uint64_t energy_mj = most[1] * (30 + draw(60)) / 100;
    const cotama_problem problem = {
        candidates, filled,
        counts, activities,
        available, {duration_ms, energy_mj},
        {number % 2 == 0 ? 0 : 1, number % 2 == 0 ? 1 : 0},
    };
    const uint64_t steps = draw(5) == 0 ? 20 + draw(200) : 100000;
    cotama_answer answer;
    printf("problem %d: %" PRIu32 " activities, %zu candidates\n", number, activities, filled);
    must(cotama_plan_by_rule(&problem, memory, sizeof memory, chosen, ACTIVITIES, &answer));
    print_answer("by the rule", &answer, chosen, activities);
    must(cotama_plan_exactly(&problem, OBJECTIVES, 2, steps, memory, sizeof memory, chosen,
                             ACTIVITIES, &answer));
    print_answer("exactly", &answer, chosen, activities);
  }
}

/* Margins. */

static void monitor_steps(void) {
  static const char *const REQUESTS[] = {"keep", "down, a margin", "down, hardware", "up"};
  static const uint64_t LIMITS[] = {600000, 8640000}, GROWTH[] = {0, 50000}, RESERVE[] = {0, 10000};
  static const uint64_t REST[] = {527924, 8563613};
  static const uint32_t ORDER[] = {0, 1};
  uint64_t memory[COTAMA_MONITOR_BYTES / 8];
  cotama_monitor *monitor;
  must(cotama_monitor_start(memory, sizeof memory, LIMITS, ORDER, &monitor));
  must(cotama_monitor_ask_upward(monitor, GROWTH, RESERVE));
  must(cotama_monitor_planned(monitor, REST));
  uint64_t rest[] = {527924, 8563613};
  for (int step = 0; step < 12; step++) {
    const uint64_t cost[] = {40000, step < 6 ? 560000 : 900000};
    rest[0] -= 40000;
    rest[1] -= 700000;
    must(cotama_monitor_spend(monitor, cost));
    int64_t margins[COTAMA_AXES];
    must(cotama_monitor_margins(monitor, rest, margins));
    uint64_t left[COTAMA_AXES];
    must(cotama_monitor_left(monitor, left));
    cotama_request request;
    uint32_t axis;
    must(cotama_monitor_assess(monitor, rest, 0x11, step == 3 ? 0x10 : 0x11, &request, &axis));
    printf("margins %" PRId64 " ms, %" PRId64 " mJ of %" PRIu64 " ms, %" PRIu64 " mJ: %s",
           margins[0], margins[1], left[0], left[1], REQUESTS[request]);
    if (axis != COTAMA_NONE) {
      printf(" of axis %" PRIu32, axis);
    }
    printf("\n");
    if (request == COTAMA_REQUEST_UP) {
      must(cotama_monitor_planned(monitor, rest));
    }
  }
}

int main(void) {
  const uint32_t version =
      COTAMA_VERSION_MAJOR << 16 | COTAMA_VERSION_MINOR << 8 | COTAMA_VERSION_PATCH;
  if (cotama_version() != version) {
    fprintf(stderr, "the library is of another version than the header\n");
    return EXIT_FAILURE;
  }
  watchdog_steps();
  ticks_steps();
  level_steps();
  allocation_steps();
  monitor_steps();
  return EXIT_SUCCESS;
}
