/* What the library refuses, function by function: null pointers, memory that is short, misaligned,
 * overlapping (all of it in overlaps.c) or of another handle, and numbers that stand for nothing.
 * Whoever is refused finds everything as it was. With an argument, bytes between numbers are not
 * compared. Exit status 0 when all was refused as it should be. */

#include "cotama.h"
#include "cotama_robot.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static int failed;

/* Whether a call answers with this error. */
#define ANSWERS(ERROR, CALL)                                                              \
  do {                                                                                    \
    const cotama_error answered = (CALL);                                                 \
    if (answered != COTAMA_ERROR_##ERROR) {                                               \
      printf("%s:%d: %s: %s\n", __FILE__, __LINE__, #CALL, cotama_error_text(answered));  \
      failed++;                                                                           \
    }                                                                                     \
    asked++;                                                                              \
  } while (0)
#define HOLDS(CONDITION)                                          \
  do {                                                            \
    if (!(CONDITION)) {                                           \
      printf("%s:%d: not %s\n", __FILE__, __LINE__, #CONDITION);  \
      failed++;                                                   \
    }                                                             \
  } while (0)

static int asked;
static uint64_t zero[COTAMA_LEVEL_BYTES / 8];

static void texts(void) {
  for (int32_t error = -3; error < 20; error++) {
    HOLDS(strlen(cotama_error_text(error)) > 0);
  }
  HOLDS(strcmp(cotama_error_text(-1), cotama_error_text(INT32_MAX)) == 0);
  cotama_text text, other;
  ANSWERS(OK, cotama_flag_name(COTAMA_FLAG_ROBOT_SILENT, &text));
  HOLDS(text.length == 12 && memcmp(text.bytes, "robot silent", 12) == 0);
  ANSWERS(BAD_NUMBER, cotama_flag_name(COTAMA_FLAG_ROBOT_SILENT + 1, &text));
  ANSWERS(NULL_POINTER, cotama_flag_name(0, NULL));
  ANSWERS(OK, cotama_module_name(COTAMA_MODULE_MCL, &text));
  HOLDS(text.length == 3 && memcmp(text.bytes, "MCL", 3) == 0);
  ANSWERS(BAD_NUMBER, cotama_module_name(COTAMA_NONE, &text));
  ANSWERS(OK, cotama_sub_objective_name(COTAMA_SUB_OBJECTIVE_FOLLOWING, &text));
  HOLDS(text.length == 9 && memcmp(text.bytes, "Following", 9) == 0);
  ANSWERS(BAD_NUMBER, cotama_sub_objective_name(COTAMA_NONE, &text));
  ANSWERS(BAD_NUMBER, cotama_configuration_name(COTAMA_NONE, &text));
  ANSWERS(OK, cotama_failure_name(COTAMA_FAILURE_PLN1, &text));
  ANSWERS(BAD_NUMBER, cotama_failure_name(COTAMA_FAILURE_PLN1 + 1, &text));
  ANSWERS(BAD_NUMBER, cotama_report_name(COTAMA_REPORT_COM1 + 1, &text));
  ANSWERS(BAD_NUMBER, cotama_loss_name(COTAMA_LOSS_WIFI_CARD + 1, &text));
  ANSWERS(BAD_NUMBER, cotama_level_transition_names(99, 0, &text, &other));
  ANSWERS(BAD_NUMBER, cotama_level_transition_names(0, 99, &text, &other));
  ANSWERS(NULL_POINTER, cotama_level_transition_names(0, 0, NULL, &text));
  ANSWERS(BAD_NUMBER, cotama_watchdog_transition_name(99, &text));
  ANSWERS(NULL_POINTER, cotama_watchdog_transition_name(0, NULL));
}

/* Puts the checksum that belongs to stored bytes at their end: CRC-32 of ISO 3309. */
static void seal(uint8_t *stored, size_t length) {
  uint32_t crc = UINT32_MAX;
  for (size_t at = 0; at < length - 4; at++) {
    crc ^= stored[at];
    for (int bit = 0; bit < 8; bit++) {
      crc = crc >> 1 ^ (crc & 1 ? UINT32_C(0xEDB88320) : 0);
    }
  }
  for (int byte = 0; byte < 4; byte++) {
    stored[length - 4 + byte] = (uint8_t)(~crc >> 8 * byte);
  }
}

static void watchdog(void) {
  uint64_t memory[COTAMA_WATCHDOG_BYTES / 8 + 1] = {0};
  unsigned char *const bytes = (unsigned char *)memory;
  cotama_watchdog *handle = NULL;
  ANSWERS(NULL_POINTER, cotama_watchdog_start(NULL, sizeof memory, 0, &handle));
  ANSWERS(NULL_POINTER, cotama_watchdog_start(memory, sizeof memory, 0, NULL));
  ANSWERS(MISALIGNED, cotama_watchdog_start(bytes + 1, sizeof memory - 1, 0, &handle));
  ANSWERS(TOO_SMALL, cotama_watchdog_start(memory, 16, 0, &handle));
  ANSWERS(OVERLAP, cotama_watchdog_start(memory, sizeof memory, 0, (cotama_watchdog **)memory));
  HOLDS(handle == NULL && memory[0] == 0);

  cotama_outcome outcome;
  cotama_firing list[2];
  cotama_firings firings = {list, 2, 0};
  ANSWERS(NULL_POINTER, cotama_watchdog_offer(NULL, 0, 0, &outcome, &firings));
  ANSWERS(NOT_STARTED, cotama_watchdog_offer((cotama_watchdog *)zero, 0, 0, &outcome, &firings));
  ANSWERS(OK, cotama_watchdog_start(memory, COTAMA_WATCHDOG_BYTES, 0, &handle));
  uint64_t before[COTAMA_WATCHDOG_BYTES / 8 + 1];
  memcpy(before, memory, sizeof memory);
  ANSWERS(MISALIGNED, cotama_watchdog_offer((cotama_watchdog *)(bytes + 4), 0, 0, &outcome, NULL));
  ANSWERS(BAD_NUMBER, cotama_watchdog_offer(handle, 0, 3, &outcome, &firings));
  ANSWERS(OVERLAP, cotama_watchdog_offer(handle, 0, 0, (cotama_outcome *)(bytes + 8), NULL));
  ANSWERS(OVERLAP, cotama_watchdog_offer(handle, 0, 0, NULL, (cotama_firings *)(bytes + 8)));
  firings.list = (cotama_firing *)memory;
  ANSWERS(OVERLAP, cotama_watchdog_offer(handle, 0, 0, NULL, &firings));
  firings.list = NULL;
  ANSWERS(NULL_POINTER, cotama_watchdog_offer(handle, 0, 0, NULL, &firings));
  firings.list = list;
  firings.room = SIZE_MAX / 2;
  ANSWERS(BAD_NUMBER, cotama_watchdog_offer(handle, 0, 0, NULL, &firings));
  firings.room = 2;
  uint64_t at;
  uint32_t place;
  ANSWERS(NULL_POINTER, cotama_watchdog_wake_at(handle, NULL));
  ANSWERS(NULL_POINTER, cotama_watchdog_wake_at(NULL, &at));
  ANSWERS(NULL_POINTER, cotama_watchdog_state(handle, NULL));
  ANSWERS(NULL_POINTER, cotama_watchdog_tokens(handle, 0, NULL));
  ANSWERS(BAD_NUMBER, cotama_watchdog_tokens(handle, COTAMA_NONE, &place));
  ANSWERS(NULL_POINTER, cotama_watchdog_advance(NULL, 0, NULL, NULL));
  uint8_t stored[COTAMA_WATCHDOG_STORED_BYTES];
  ANSWERS(TOO_SMALL, cotama_watchdog_store(handle, stored, sizeof stored - 1, NULL));
  ANSWERS(NULL_POINTER, cotama_watchdog_store(handle, NULL, sizeof stored, NULL));
  ANSWERS(OVERLAP, cotama_watchdog_store(handle, bytes + 8, sizeof stored, NULL));
  HOLDS(memcmp(before, memory, sizeof memory) == 0);

  /* More fires than there is room for: all of it is counted. */
  ANSWERS(OK, cotama_watchdog_offer(handle, 0, COTAMA_WATCHDOG_EVENT_RELEASE, NULL, NULL));
  firings.room = 1;
  ANSWERS(OK, cotama_watchdog_advance(handle, 500, NULL, &firings));
  HOLDS(firings.count == 2 && list[0].at_ms == 100);
  firings.room = 0;
  firings.list = NULL;
  ANSWERS(OK, cotama_watchdog_offer(handle, 600, COTAMA_WATCHDOG_EVENT_RELEASE, NULL, &firings));
  HOLDS(firings.count == 1);

  /* Every damaged byte of a stored one is refused, and the memory stays as it was. */
  size_t written = 0;
  ANSWERS(OK, cotama_watchdog_store(handle, stored, sizeof stored, &written));
  HOLDS(written == sizeof stored);
  memcpy(before, memory, sizeof memory);
  for (size_t byte = 0; byte < sizeof stored; byte++) {
    for (int bit = 0; bit < 8; bit++) {
      stored[byte] ^= (uint8_t)(1 << bit);
      ANSWERS(DAMAGED, cotama_watchdog_restore(memory, sizeof memory, 0, stored, written, &handle));
      stored[byte] ^= (uint8_t)(1 << bit);
    }
  }
  ANSWERS(DAMAGED, cotama_watchdog_restore(memory, sizeof memory, 0, stored, written - 1, &handle));
  ANSWERS(NULL_POINTER, cotama_watchdog_restore(memory, sizeof memory, 0, NULL, written, &handle));
  ANSWERS(OVERLAP, cotama_watchdog_restore(memory, sizeof memory, 0, bytes, written, &handle));
  ANSWERS(TOO_SMALL, cotama_watchdog_restore(memory, 8, 0, stored, written, &handle));
  /* The checksum is right, and the bytes are wrong all the same: the first eight tell the net, the
   * next eight are the marking. */
  uint8_t forged[COTAMA_WATCHDOG_STORED_BYTES];
  memcpy(forged, stored, sizeof forged);
  forged[0] ^= 1;
  seal(forged, sizeof forged);
  ANSWERS(OTHER_NET, cotama_watchdog_restore(memory, sizeof memory, 0, forged, written, &handle));
  memcpy(forged, stored, sizeof forged);
  memset(forged + 8, 0, 8);
  seal(forged, sizeof forged);
  ANSWERS(IMPOSSIBLE, cotama_watchdog_restore(memory, sizeof memory, 0, forged, written, &handle));
  HOLDS(memcmp(before, memory, sizeof memory) == 0);
  memcpy(forged, stored, sizeof forged);
  seal(forged, sizeof forged);
  HOLDS(memcmp(forged, stored, sizeof forged) == 0);
  ANSWERS(OK, cotama_watchdog_restore(memory, sizeof memory, 0, stored, written, &handle));
}

/* Valgrind knows that bytes between two numbers of a handle stand for nothing. */
static bool compares_padding = true;

/* Stored bytes of a level: every damaged byte is refused, and what cannot be. */
static void stored_level(void) {
  static uint64_t memory[COTAMA_LEVEL_BYTES / 8];
  unsigned char *const bytes = (unsigned char *)memory;
  cotama_level *handle;
  ANSWERS(OK, cotama_level_start(memory, sizeof memory, COTAMA_ROBOT, &handle));
  uint8_t stored[COTAMA_LEVEL_STORED_BYTES];
  size_t written = 0;
  ANSWERS(TOO_SMALL, cotama_level_store(handle, stored, sizeof stored - 1, NULL));
  ANSWERS(NULL_POINTER, cotama_level_store(handle, NULL, sizeof stored, NULL));
  ANSWERS(OVERLAP, cotama_level_store(handle, bytes + 8, sizeof stored, NULL));
  ANSWERS(OK, cotama_level_store(handle, stored, sizeof stored, &written));
  HOLDS(written == sizeof stored);
  uint64_t before[COTAMA_LEVEL_BYTES / 8];
  memcpy(before, memory, sizeof memory);
#define RESTORE(STORED, LENGTH) \
  cotama_level_restore(memory, sizeof memory, COTAMA_ROBOT, 0, STORED, LENGTH, &handle)
  for (size_t byte = 0; byte < sizeof stored; byte++) {
    for (int bit = 0; bit < 8; bit++) {
      stored[byte] ^= (uint8_t)(1 << bit);
      ANSWERS(DAMAGED, RESTORE(stored, written));
      stored[byte] ^= (uint8_t)(1 << bit);
    }
  }
  ANSWERS(DAMAGED, RESTORE(stored, written - 1));
  ANSWERS(NULL_POINTER, RESTORE(NULL, written));
  ANSWERS(OVERLAP, RESTORE(bytes, written));
  ANSWERS(TOO_SMALL,
          cotama_level_restore(memory, 500, COTAMA_ROBOT, 0, stored, written, &handle));
  ANSWERS(OTHER_ROBOT,
          cotama_level_restore(memory, sizeof memory, 7, 0, stored, written, &handle));
  /* The first eight bytes tell the system, the marking follows them. */
  uint8_t forged[COTAMA_LEVEL_STORED_BYTES];
  memcpy(forged, stored, sizeof forged);
  forged[0] ^= 1;
  seal(forged, sizeof forged);
  ANSWERS(OTHER_NET, RESTORE(forged, written));
  memcpy(forged, stored, sizeof forged);
  memset(forged + 8, 0, 8);
  seal(forged, sizeof forged);
  ANSWERS(IMPOSSIBLE, RESTORE(forged, written));
  if (compares_padding) {
    HOLDS(memcmp(before, memory, sizeof memory) == 0);
  }
  ANSWERS(OK, RESTORE(stored, written));
}

static void level(void) {
  static uint64_t memory[COTAMA_LEVEL_BYTES / 8];
  unsigned char *const bytes = (unsigned char *)memory;
  cotama_level *handle = NULL;
  ANSWERS(NULL_POINTER, cotama_level_start(NULL, sizeof memory, COTAMA_ROBOT, &handle));
  ANSWERS(MISALIGNED, cotama_level_start(bytes + 4, sizeof memory, COTAMA_ROBOT, &handle));
  ANSWERS(TOO_SMALL, cotama_level_start(memory, 500, COTAMA_ROBOT, &handle));
  ANSWERS(OTHER_ROBOT, cotama_level_start(memory, sizeof memory, COTAMA_ROBOT + 1, &handle));
  HOLDS(handle == NULL);
  ANSWERS(OK, cotama_level_start(memory, sizeof memory, COTAMA_ROBOT, &handle));

  uint64_t before[COTAMA_LEVEL_BYTES / 8];
  memcpy(before, memory, sizeof memory);
  const cotama_drive drive = {0, 1};
  cotama_perceived seen = {0, 0, COTAMA_MODULES_ALL};
  uint32_t found[1];
  cotama_failures failures = {found, 1, 0};
  ANSWERS(NULL_POINTER, cotama_level_perceive(NULL, 0, &seen, NULL));
  ANSWERS(NULL_POINTER, cotama_level_perceive(handle, 0, NULL, NULL));
  seen.raised = COTAMA_FLAGS_ALL + 1;
  ANSWERS(BAD_NUMBER, cotama_level_perceive(handle, 0, &seen, &failures));
  seen.raised = 0;
  seen.lowered = UINT64_MAX;
  ANSWERS(BAD_NUMBER, cotama_level_perceive(handle, 0, &seen, &failures));
  seen.lowered = 0;
  seen.works = COTAMA_MODULES_ALL + 1;
  ANSWERS(BAD_NUMBER, cotama_level_perceive(handle, 0, &seen, &failures));
  seen.works = COTAMA_MODULES_ALL;
  ANSWERS(OVERLAP, cotama_level_perceive(handle, 0, &seen, (cotama_failures *)memory));
  failures.list = (uint32_t *)memory;
  ANSWERS(OVERLAP, cotama_level_perceive(handle, 0, &seen, &failures));
  failures.list = NULL;
  ANSWERS(NULL_POINTER, cotama_level_perceive(handle, 0, &seen, &failures));
  ANSWERS(BAD_NUMBER, cotama_level_report(handle, COTAMA_FAILURE_PLN1 + 1));
  ANSWERS(NULL_POINTER, cotama_level_report(NULL, COTAMA_FAILURE_PLN1));
  ANSWERS(NULL_POINTER, cotama_level_round(handle, 0, NULL, NULL, NULL, NULL));
  static const cotama_told NONSENSE[] = {
      {COTAMA_WORD_NOTHING, 1},
      {COTAMA_WORD_BEGINS, 1},
      {COTAMA_WORD_OVER, COTAMA_STEP_DRIVEA}, /* a drive ends when its goal is reached */
      {COTAMA_WORD_OVER, COTAMA_STEP_DELIVER + 1},
      {COTAMA_WORD_STOPPED, 1},
      {COTAMA_WORD_REACHED, COTAMA_SUB_OBJECTIVE_TELEOPERATION + 1},
      {COTAMA_WORD_REPORT, COTAMA_REPORT_COM1 + 1},
      {COTAMA_WORD_BACK, COTAMA_LOSS_WIFI_CARD + 1},
      {COTAMA_WORD_CHOOSES, COTAMA_SUB_OBJECTIVE_FOLLOWING}, /* not the operator's */
      {COTAMA_WORD_DONE, COTAMA_NONE},
      {COTAMA_WORD_GIVES_UP, 1},
      {COTAMA_WORD_GIVES_UP + 1, 0},
      {COTAMA_NONE, 0},
  };
  for (size_t at = 0; at < sizeof NONSENSE / sizeof *NONSENSE; at++) {
    ANSWERS(BAD_NUMBER, cotama_level_round(handle, 0, &NONSENSE[at], &drive, NULL, NULL));
  }
  ANSWERS(OVERLAP, cotama_level_round(handle, 0, NULL, &drive, (cotama_round *)memory, NULL));
  ANSWERS(NULL_POINTER, cotama_level_requests(handle, 0, NULL));
  ANSWERS(NULL_POINTER, cotama_level_listens(handle, NULL));
  ANSWERS(NOT_STARTED, cotama_level_requests((cotama_level *)zero, 0, NULL));
  uint64_t at;
  ANSWERS(NOT_STARTED, cotama_watchdog_wake_at((cotama_watchdog *)memory, &at));
  if (compares_padding) {
    HOLDS(memcmp(before, memory, sizeof memory) == 0);
  }

  /* What an interrupt finds, while a call uses the level: the complement of its mark. */
  cotama_requests requests;
  memory[0] = ~memory[0];
  ANSWERS(BUSY, cotama_level_perceive(handle, 0, &seen, NULL));
  ANSWERS(BUSY, cotama_level_round(handle, 0, NULL, &drive, NULL, NULL));
  ANSWERS(BUSY, cotama_level_requests(handle, 0, &requests));
  memory[0] = ~memory[0];

  /* More is found than there is room for: all of it is counted, and the worst is noted. */
  failures.list = found;
  seen.raised = UINT64_C(1) << COTAMA_FLAG_BUMPER;
  ANSWERS(OK, cotama_level_perceive(handle, 100, &seen, &failures));
  HOLDS(failures.count == 2 && found[0] == COTAMA_FAILURE_LOC3);
  seen.raised = 0;
  ANSWERS(OK, cotama_level_perceive(handle, 200, &seen, &failures));
  HOLDS(failures.count == 0);
  ANSWERS(OK, cotama_level_round(handle, 200, NULL, &drive, NULL, NULL));
  ANSWERS(OK, cotama_level_start(memory, sizeof memory, COTAMA_ROBOT, &handle));
}

/* Memory in which nothing was started, whatever its bytes are, is of no handle; and a level, a
 * watchdog and a monitor may be started there. */
static void never_started(void) {
  static uint64_t memory[COTAMA_LEVEL_BYTES / 8];
  static const unsigned char FILLS[] = {0x00, 0xFF, 0x55, 0xAA, 0xA5, 0xEF, 0x01};
  for (size_t at = 0; at < sizeof FILLS; at++) {
    const cotama_drive drive = {0, 1};
    const cotama_perceived seen = {0, 0, COTAMA_MODULES_ALL};
    const uint64_t amounts[] = {1, 1};
    union {
      uint64_t number;
      uint64_t amounts[COTAMA_AXES];
      int64_t margins[COTAMA_AXES];
      uint32_t place;
      uint8_t stored[COTAMA_WATCHDOG_STORED_BYTES];
      bool listens;
      cotama_requests requests;
      cotama_request request;
    } to;
    memset(memory, FILLS[at], sizeof memory);
    cotama_watchdog *watchdog = (cotama_watchdog *)memory;
    ANSWERS(NOT_STARTED, cotama_watchdog_offer(watchdog, 0, 0, NULL, NULL));
    ANSWERS(NOT_STARTED, cotama_watchdog_advance(watchdog, 0, NULL, NULL));
    ANSWERS(NOT_STARTED, cotama_watchdog_wake_at(watchdog, &to.number));
    ANSWERS(NOT_STARTED, cotama_watchdog_went_back(watchdog, 0, &to.number));
    ANSWERS(NOT_STARTED, cotama_watchdog_state(watchdog, &to.place));
    ANSWERS(NOT_STARTED, cotama_watchdog_tokens(watchdog, 0, &to.place));
    ANSWERS(NOT_STARTED, cotama_watchdog_store(watchdog, to.stored, sizeof to.stored, NULL));
    cotama_level *level = (cotama_level *)memory;
    ANSWERS(NOT_STARTED, cotama_level_perceive(level, 0, &seen, NULL));
    ANSWERS(NOT_STARTED, cotama_level_report(level, 0));
    ANSWERS(NOT_STARTED, cotama_level_listens(level, &to.listens));
    ANSWERS(NOT_STARTED, cotama_level_round(level, 0, NULL, &drive, NULL, NULL));
    ANSWERS(NOT_STARTED, cotama_level_requests(level, 0, &to.requests));
    ANSWERS(NOT_STARTED, cotama_level_store(level, to.stored, sizeof to.stored, NULL));
    cotama_monitor *monitor = (cotama_monitor *)memory;
    ANSWERS(NOT_STARTED, cotama_monitor_ask_upward(monitor, amounts, amounts));
    ANSWERS(NOT_STARTED, cotama_monitor_hardware_returned(monitor));
    ANSWERS(NOT_STARTED, cotama_monitor_planned(monitor, amounts));
    ANSWERS(NOT_STARTED, cotama_monitor_spend(monitor, amounts));
    ANSWERS(NOT_STARTED, cotama_monitor_left(monitor, to.amounts));
    ANSWERS(NOT_STARTED, cotama_monitor_margins(monitor, amounts, to.margins));
    ANSWERS(NOT_STARTED, cotama_monitor_assess(monitor, amounts, 0, 0, &to.request, NULL));
    ANSWERS(OK, cotama_level_start(memory, sizeof memory, COTAMA_ROBOT, &level));
    ANSWERS(NOT_STARTED, cotama_monitor_hardware_returned(monitor));
    ANSWERS(NOT_STARTED, cotama_watchdog_wake_at(watchdog, &to.number));
    memset(memory, FILLS[at], sizeof memory);
    ANSWERS(OK, cotama_watchdog_start(memory, sizeof memory, 0, &watchdog));
    ANSWERS(NOT_STARTED, cotama_level_listens((cotama_level *)memory, &to.listens));
  }
}

/* A clock that went back, and a counter that begins anew. */
static void clocks(void) {
  uint64_t memory[COTAMA_WATCHDOG_BYTES / 8], now = 0, back = 7;
  cotama_watchdog *handle;
  ANSWERS(OK, cotama_watchdog_start(memory, sizeof memory, 1000, &handle));
  ANSWERS(NULL_POINTER, cotama_watchdog_went_back(handle, 0, NULL));
  ANSWERS(NULL_POINTER, cotama_watchdog_went_back(NULL, 0, &back));
  HOLDS(back == 7);
  ANSWERS(OK, cotama_watchdog_went_back(handle, 400, &back));
  HOLDS(back == 600);
  ANSWERS(OK, cotama_watchdog_went_back(handle, 1000, &back));
  HOLDS(back == 0);
  ANSWERS(OK, cotama_watchdog_went_back(handle, UINT64_MAX, &back));
  HOLDS(back == 0);
  cotama_ticks ticks = {UINT32_MAX};
  ANSWERS(NULL_POINTER, cotama_ticks_widen(NULL, 0, &now));
  ANSWERS(NULL_POINTER, cotama_ticks_widen(&ticks, 0, NULL));
  ANSWERS(MISALIGNED, cotama_ticks_widen((cotama_ticks *)((char *)&ticks + 1), 0, &now));
  HOLDS(now == 0 && ticks.latest_ms == UINT32_MAX);
  ANSWERS(OK, cotama_ticks_widen(&ticks, 4, &now));
  HOLDS(now == UINT64_C(0x100000004) && ticks.latest_ms == now);
  ANSWERS(OK, cotama_ticks_widen(&ticks, UINT32_MAX, &now));
  HOLDS(now == UINT32_MAX && ticks.latest_ms == UINT64_C(0x100000004));
}

static void allocation(void) {
  const cotama_candidate candidates[] = {{0, {10, 10}, 1}, {1, {5, 5}, 0}, {0x10, {1, 1}, 9}};
  const uint32_t counts[] = {2, 1}, too_few[] = {1, 1}, too_many[] = {2, 2}, none[] = {3, 0};
  const uint32_t objectives[] = {0, 1, 2, 3, 4}, no_objective[] = {5};
  cotama_problem problem = {candidates, 3, counts, 2, 0x11, {20, 20}, {0, 1}};
  const cotama_problem sound = problem;
  uint64_t memory[COTAMA_EXACT_BYTES(2, 3) / 8];
  uint16_t plan[2] = {7, 7};
  cotama_answer answer;
#define BY_RULE cotama_plan_by_rule(&problem, memory, sizeof memory, plan, 2, &answer)
  ANSWERS(NULL_POINTER, cotama_plan_by_rule(NULL, memory, sizeof memory, plan, 2, &answer));
  ANSWERS(NULL_POINTER, cotama_plan_by_rule(&problem, NULL, sizeof memory, plan, 2, &answer));
  ANSWERS(NULL_POINTER, cotama_plan_by_rule(&problem, memory, sizeof memory, NULL, 2, &answer));
  ANSWERS(NULL_POINTER, cotama_plan_by_rule(&problem, memory, sizeof memory, plan, 2, NULL));
  ANSWERS(TOO_SMALL, cotama_plan_by_rule(&problem, memory, sizeof memory, plan, 1, &answer));
  ANSWERS(TOO_SMALL, cotama_plan_by_rule(&problem, memory, 40, plan, 2, &answer));
  uint16_t *const within = (uint16_t *)memory;
  ANSWERS(OVERLAP, cotama_plan_by_rule(&problem, memory, sizeof memory, within, 2, &answer));
  ANSWERS(OVERLAP, cotama_plan_by_rule(&problem, memory, sizeof memory, plan, 2, (void *)memory));
  ANSWERS(OVERLAP, cotama_plan_by_rule(&problem, (void *)candidates, 72, plan, 2, &answer));
  problem.candidates = NULL;
  ANSWERS(NULL_POINTER, BY_RULE);
  problem = sound;
  problem.counts = too_few;
  ANSWERS(BAD_NUMBER, BY_RULE);
  problem.counts = too_many;
  ANSWERS(BAD_NUMBER, BY_RULE);
  problem.counts = none;
  ANSWERS(NO_CANDIDATES, BY_RULE);
  problem = sound;
  problem.order[1] = 0;
  ANSWERS(BAD_NUMBER, BY_RULE);
  problem = sound;
  problem.available = 0x8;
  ANSWERS(BAD_NUMBER, BY_RULE);
  problem = sound;
  problem.candidate_count = SIZE_MAX;
  ANSWERS(BAD_NUMBER, BY_RULE);
  HOLDS(plan[0] == 7 && plan[1] == 7);
  problem = sound;
  problem.available = 1;
  ANSWERS(OK, BY_RULE);
  HOLDS(answer.verdict == COTAMA_VERDICT_WITHOUT_HARDWARE && answer.activity == 1);
  problem = sound;
#define EXACTLY(LIST, COUNT, BYTES) \
  cotama_plan_exactly(&problem, LIST, COUNT, 1000, memory, BYTES, plan, 2, &answer)
  ANSWERS(NULL_POINTER, EXACTLY(NULL, 1, sizeof memory));
  ANSWERS(BAD_NUMBER, EXACTLY(no_objective, 1, sizeof memory));
  ANSWERS(BAD_NUMBER, EXACTLY(objectives, 5, sizeof memory));
  ANSWERS(TOO_SMALL, EXACTLY(objectives, 1, 300));
  ANSWERS(OK, EXACTLY(objectives, 4, sizeof memory));
  ANSWERS(OK, EXACTLY(NULL, 0, sizeof memory));
  /* The bytes that the header promises are enough, wherever they begin. */
  ANSWERS(OK, cotama_plan_exactly(&problem, objectives, 1, 1000, (unsigned char *)memory + 3,
                                  sizeof memory - 3, plan, 2, &answer));
  HOLDS(answer.verdict == COTAMA_VERDICT_PLANNED && plan[0] == 0 && plan[1] == 0);
  uint64_t less[COTAMA_RULE_BYTES(2, 3) / 8];
  ANSWERS(OK, cotama_plan_by_rule(&problem, less, sizeof less, plan, 2, &answer));
}

static void monitor(void) {
  uint64_t memory[COTAMA_MONITOR_BYTES / 8];
  const uint64_t limits[] = {100, 200}, huge[] = {UINT64_MAX, 0}, rest[] = {50, 50};
  const uint32_t order[] = {0, 1}, twice[] = {1, 1};
  cotama_monitor *handle = NULL;
  ANSWERS(NULL_POINTER, cotama_monitor_start(memory, sizeof memory, NULL, order, &handle));
  ANSWERS(NULL_POINTER, cotama_monitor_start(memory, sizeof memory, limits, NULL, &handle));
  ANSWERS(BAD_NUMBER, cotama_monitor_start(memory, sizeof memory, huge, order, &handle));
  ANSWERS(BAD_NUMBER, cotama_monitor_start(memory, sizeof memory, limits, twice, &handle));
  ANSWERS(TOO_SMALL, cotama_monitor_start(memory, 8, limits, order, &handle));
  ANSWERS(OK, cotama_monitor_start(memory, sizeof memory, limits, order, &handle));
  cotama_request request;
  int64_t margins[COTAMA_AXES];
  ANSWERS(BAD_NUMBER, cotama_monitor_planned(handle, huge));
  ANSWERS(BAD_NUMBER, cotama_monitor_spend(handle, huge));
  ANSWERS(BAD_NUMBER, cotama_monitor_margins(handle, huge, margins));
  ANSWERS(BAD_NUMBER, cotama_monitor_ask_upward(handle, huge, rest));
  ANSWERS(BAD_NUMBER, cotama_monitor_assess(handle, rest, 8, 0, &request, NULL));
  ANSWERS(NULL_POINTER, cotama_monitor_assess(handle, rest, 0, 0, NULL, NULL));
  ANSWERS(NULL_POINTER, cotama_monitor_left(handle, NULL));
  ANSWERS(OVERLAP, cotama_monitor_left(handle, memory + 2));
  ANSWERS(NOT_STARTED, cotama_monitor_hardware_returned((cotama_monitor *)zero));
  ANSWERS(OK, cotama_monitor_hardware_returned(handle));
  ANSWERS(OK, cotama_monitor_assess(handle, rest, 0, 0, &request, NULL));
  HOLDS(request == COTAMA_REQUEST_KEEP);
}

int main(int count, char **arguments) {
  (void)arguments;
  compares_padding = count == 1;
  texts();
  watchdog();
  level();
  stored_level();
  allocation();
  monitor();
  never_started();
  clocks();
  printf("%d calls answered as they should, %d not\n", asked - failed, failed);
  return failed == 0 ? 0 : 1;
}
