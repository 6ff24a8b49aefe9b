/* Cotama from C: supervisors, the decisional level of a robot, allocation.
 *
 * Memory is the caller's, and there is no heap: each handle has a number of bytes, the constant
 * COTAMA_..._BYTES, and lies at an address that is a multiple of 8. Functions answer with a
 * cotama_error; where it is not COTAMA_ERROR_OK, nothing has happened. Times are milliseconds of
 * the caller's clock. A handle is for one thread at a time.
 *
 * The numbers of the robot, and the bytes of its level, are those of cotama_robot.h. */

#ifndef COTAMA_H
#define COTAMA_H

/* Made by cbindgen of firmware/c; firmware/c/check.sh compares it. */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The version of this header, as numbers. Programs made with one minor version of 0 need a library
// of that one.
#define COTAMA_VERSION_MAJOR 0

// See [`COTAMA_VERSION_MAJOR`].
#define COTAMA_VERSION_MINOR 1

// See [`COTAMA_VERSION_MAJOR`].
#define COTAMA_VERSION_PATCH 0

// The axes of a mission: 0 is the duration in ms, 1 the energy in mJ.
#define COTAMA_AXES 2

// The most objectives of a call.
#define COTAMA_OBJECTIVES 4

// Bytes of memory that planning by the rule needs for each activity,
#define COTAMA_RULE_ACTIVITY_BYTES 24

// for each candidate,
#define COTAMA_RULE_CANDIDATE_BYTES 16

// bytes that planning exactly needs for each activity,
#define COTAMA_EXACT_ACTIVITY_BYTES 288

// for each candidate,
#define COTAMA_EXACT_CANDIDATE_BYTES 48

// and what either needs beside these.
#define COTAMA_PLANNING_BYTES 64

// "None", where a number stands for something: no configuration, no axis.
#define COTAMA_NONE UINT32_MAX

// "Never", where a number is an instant.
#define COTAMA_NEVER UINT64_MAX

// The bytes of a `cotama_monitor`, at an address that is a multiple of 8.
#define COTAMA_MONITOR_BYTES 128

// The bytes of a `cotama_watchdog`, at an address that is a multiple of 8.
#define COTAMA_WATCHDOG_BYTES 48

// The bytes of a stored one.
#define COTAMA_WATCHDOG_STORED_BYTES 32

// The result of a call. If it is not `COTAMA_ERROR_OK`, nothing has happened: nothing has fired,
// and no memory is written but the working memory of planning.
enum cotama_error
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // The call has succeeded.
  COTAMA_ERROR_OK = 0,
  // A pointer is null that must not be.
  COTAMA_ERROR_NULL_POINTER = 1,
  // Memory is not aligned as its type needs it.
  COTAMA_ERROR_MISALIGNED = 2,
  // Memory is shorter than what it is for.
  COTAMA_ERROR_TOO_SMALL = 3,
  // Memory that is written overlaps memory that is used at the same time.
  COTAMA_ERROR_OVERLAP = 4,
  // The memory holds no such handle: none was started there, or one of another type.
  COTAMA_ERROR_NOT_STARTED = 5,
  // The handle is in use by a call that this one has interrupted.
  COTAMA_ERROR_BUSY = 6,
  // A number stands for nothing here, or is out of its range.
  COTAMA_ERROR_BAD_NUMBER = 7,
  // An activity has no candidate.
  COTAMA_ERROR_NO_CANDIDATES = 8,
  // Stored bytes are not as they were written.
  COTAMA_ERROR_DAMAGED = 9,
  // Stored bytes are of another net, or of another version of it.
  COTAMA_ERROR_OTHER_NET = 10,
  // Stored bytes say what cannot be, such as a broken law.
  COTAMA_ERROR_IMPOSSIBLE = 11,
  // The numbers of the header are of another robot, or of another mission.
  COTAMA_ERROR_OTHER_ROBOT = 12,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_error cotama_error;
#else
typedef int32_t cotama_error;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The verdict of an allocator.
enum cotama_verdict
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // A plan within every limit.
  COTAMA_VERDICT_PLANNED = 0,
  // No plan: proven by the exact one; the rule may miss a plan.
  COTAMA_VERDICT_INFEASIBLE = 1,
  // The steps ended before a plan was found or excluded.
  COTAMA_VERDICT_OUT_OF_BUDGET = 2,
  // An activity has no candidate with the hardware that there is.
  COTAMA_VERDICT_WITHOUT_HARDWARE = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_verdict cotama_verdict;
#else
typedef int32_t cotama_verdict;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The request of a monitor.
enum cotama_request
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Nothing; go on.
  COTAMA_REQUEST_KEEP = 0,
  // A plan that needs less: the margin of the axis named is below zero.
  COTAMA_REQUEST_DOWN_MARGIN = 1,
  // A plan without hardware that is lost.
  COTAMA_REQUEST_DOWN_HARDWARE = 2,
  // A better plan, as margins have grown.
  COTAMA_REQUEST_UP = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_request cotama_request;
#else
typedef int32_t cotama_request;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The outcome of an event that was offered.
enum cotama_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // A transition on it fired.
  COTAMA_OUTCOME_FIRED = 0,
  // The event is ignored: a marked place does so on purpose.
  COTAMA_OUTCOME_IGNORED_ON_PURPOSE = 1,
  // The event is ignored: no transition on it has the tokens that it needs.
  COTAMA_OUTCOME_NOT_ENABLED = 2,
  // The event is ignored: the interval of the transition on it has not begun.
  COTAMA_OUTCOME_TOO_EARLY = 3,
  // The event is ignored: the interval of the transition on it is over.
  COTAMA_OUTCOME_TOO_LATE = 4,
  // The event is ignored: a place would hold more than its bound.
  COTAMA_OUTCOME_FULL = 5,
  // The event is ignored: there is more to catch up with first, so advance, and offer it again.
  COTAMA_OUTCOME_BEHIND = 6,
  // The event is refused: a mailbox on its path is full.
  COTAMA_OUTCOME_REFUSED = 7,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_outcome cotama_outcome;
#else
typedef int32_t cotama_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A word for the supervisors: what it is about.
enum cotama_word
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Nobody says anything.
  COTAMA_WORD_NOTHING = 0,
  // The mission begins; of a robot without one, a drive.
  COTAMA_WORD_BEGINS = 1,
  // The task for which the robot stands in an objective, a `COTAMA_STEP_...`, is done.
  COTAMA_WORD_OVER = 2,
  // The robot stands, after the mission was ended.
  COTAMA_WORD_STOPPED = 3,
  // A sub-objective, a `COTAMA_SUB_OBJECTIVE_...`, is reached.
  COTAMA_WORD_REACHED = 4,
  // Failures of a report, a `COTAMA_REPORT_...`, were found.
  COTAMA_WORD_REPORT = 5,
  // Parts that a loss, a `COTAMA_LOSS_...`, took work again.
  COTAMA_WORD_BACK = 6,
  // The operator chooses one of his sub-objectives.
  COTAMA_WORD_CHOOSES = 7,
  // The operator is done with one of his sub-objectives.
  COTAMA_WORD_DONE = 8,
  // The operator gives up, or is silent for too long.
  COTAMA_WORD_GIVES_UP = 9,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_word cotama_word;
#else
typedef uint32_t cotama_word;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The criterion by which a plan is chosen.
enum cotama_objective
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // The most total quality.
  COTAMA_OBJECTIVE_MOST_QUALITY = 0,
  // The least total duration.
  COTAMA_OBJECTIVE_LEAST_DURATION = 1,
  // The least total energy.
  COTAMA_OBJECTIVE_LEAST_ENERGY = 2,
  // The most total duration within its limit; objectives behind it are not treated.
  COTAMA_OBJECTIVE_MOST_DURATION = 3,
  // The most total energy within its limit; objectives behind it are not treated.
  COTAMA_OBJECTIVE_MOST_ENERGY = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_objective cotama_objective;
#else
typedef uint32_t cotama_objective;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The events of a watchdog.
enum cotama_watchdog_event
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // The scheduler starts a job.
  COTAMA_WATCHDOG_EVENT_RELEASE = 0,
  // The job is done.
  COTAMA_WATCHDOG_EVENT_DONE = 1,
  // The supervisor has dealt with the fault.
  COTAMA_WATCHDOG_EVENT_CS_ACK = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_watchdog_event cotama_watchdog_event;
#else
typedef uint32_t cotama_watchdog_event;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The outputs of a watchdog: the bits of `outputs` in a firing, by their numbers.
enum cotama_watchdog_output
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // The job is stopped.
  COTAMA_WATCHDOG_OUTPUT_SKIP_JOB = 0,
  // The module misses its deadlines persistently.
  COTAMA_WATCHDOG_OUTPUT_RT_FAULT = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_watchdog_output cotama_watchdog_output;
#else
typedef uint32_t cotama_watchdog_output;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The places of a watchdog; one of the first four is marked.
enum cotama_watchdog_place
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // No job of the module runs.
  COTAMA_WATCHDOG_PLACE_IDLE = 0,
  // A job runs, and its deadline is ahead.
  COTAMA_WATCHDOG_PLACE_RUN = 1,
  // A job runs on in its extra time.
  COTAMA_WATCHDOG_PLACE_EXTRA = 2,
  // The fault was reported; the module stands still.
  COTAMA_WATCHDOG_PLACE_FAULT = 3,
  // Deadlines missed in a row: ask for its tokens.
  COTAMA_WATCHDOG_PLACE_MISSES = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cotama_watchdog_place cotama_watchdog_place;
#else
typedef uint32_t cotama_watchdog_place;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The decisional level, in the caller's memory: diagnosis, supervisors and settings.
typedef struct cotama_level cotama_level;

// A monitor of the margins of a mission, in the caller's memory.
typedef struct cotama_monitor cotama_monitor;

// The watchdog of one module, in the caller's memory.
typedef struct cotama_watchdog cotama_watchdog;

// One way to do an activity.
typedef struct cotama_candidate {
  // The hardware that it needs: 0 to 7 units of each of 16 kinds, four bits a kind, the top one
  // of them 0. Kind 0 is lowest.
  uint64_t units;
  // Cost on each axis.
  uint32_t cost[COTAMA_AXES];
  // How good the activity is done this way; larger is better. Qualities add up.
  uint32_t quality;
} cotama_candidate;

// Activities in sequence with their candidates, and limits.
typedef struct cotama_problem {
  // The candidates of all activities, one activity after the other.
  const struct cotama_candidate *candidates;
  // How many there are in all.
  size_t candidate_count;
  // How many of them each activity has.
  const uint32_t *counts;
  // How many activities there are; at most 65,535, as of the candidates of one.
  size_t activity_count;
  // The hardware that there is, as in `units`: candidates that need more are left out.
  uint64_t available;
  // The most that a plan may cost on each axis.
  uint64_t limits[COTAMA_AXES];
  // The axes in their order of treatment: each once.
  uint32_t order[COTAMA_AXES];
} cotama_problem;

// The answer of an allocator. What is not said of its verdict is 0; `axis` is `COTAMA_NONE` then.
typedef struct cotama_answer {
  // Verdict of the allocator.
  cotama_verdict verdict;
  // For a plan: no plan is better in the objectives.
  bool optimal;
  // `bound` is known.
  bool bounded;
  // For a plan: its cost on each axis.
  uint64_t cost[COTAMA_AXES];
  // For a plan: its quality.
  uint64_t quality;
  // No plan has more in the first objective; or less, where the least is asked for.
  uint64_t bound;
  // The work done, in the allocator's steps.
  uint64_t steps;
  // Without a plan: the axis whose limit is not met; `COTAMA_NONE` where that is not known.
  uint32_t axis;
  // Without hardware: the activity.
  uint32_t activity;
  // Without a plan: the limit of that axis,
  uint64_t limit;
  // and the least that can be reached there.
  uint64_t least;
} cotama_answer;

// The news of observers and the scheduler in a period.
typedef struct cotama_perceived {
  // Flags that are raised now: bit `n` is `COTAMA_FLAG_...` `n`.
  uint64_t raised;
  // Flags that were raised and have gone back.
  uint64_t lowered;
  // The modules that say that they work, in use or not: bit `n` is `COTAMA_MODULE_...` `n`.
  uint64_t works;
} cotama_perceived;

// Memory for the failures that are found during a call, the worst first, each a
// `COTAMA_FAILURE_...`.
typedef struct cotama_failures {
  // Memory for failures; null when `room` is 0.
  uint32_t *list;
  // For how many.
  size_t room;
  // Number of them: written by each call. Those beyond `room` are counted, not noted.
  size_t count;
} cotama_failures;

// Something that the supervisors are told.
typedef struct cotama_told {
  // A `cotama_word`,
  uint32_t word;
  // and the number of what it is about; 0 where it is about nothing that has one.
  uint32_t number;
} cotama_told;

// State of the drive: 0 says no, any other number yes.
typedef struct cotama_drive {
  // The goal of the drive is reached.
  uint8_t at_goal;
  // The robot does not move.
  uint8_t stands;
} cotama_drive;

// The outcome of a round.
typedef struct cotama_round {
  // The modules that are to be started anew now: bit `n` is `COTAMA_MODULE_...` `n`.
  uint64_t restarts;
  // Word that the supervisors accepted; `COTAMA_WORD_NOTHING` where there was none.
  struct cotama_told told;
} cotama_round;

// A transition that has fired.
typedef struct cotama_firing {
  // When, ms: what was due earlier than the call fired when it was due.
  uint64_t at_ms;
  // The outputs emitted: bit `n` is output `n` of its net.
  uint64_t outputs;
  // Number of the net in the system; 0 for a net alone.
  uint32_t net;
  // The transition, by its number in the net.
  uint32_t transition;
} cotama_firing;

// Memory for what fires during a call, in its order.
typedef struct cotama_firings {
  // Memory for firings; null when `room` is 0.
  struct cotama_firing *list;
  // For how many.
  size_t room;
  // How many there were: written by each call. Those beyond `room` are counted, not noted.
  size_t count;
} cotama_firings;

// The requests to the robot until the next round.
typedef struct cotama_requests {
  // The fastest it may go, mm/s, as the configuration and the settings leave it.
  uint64_t speed_mm_s;
  // The reports whose settings hold: bit `n` is `COTAMA_REPORT_...` `n`.
  uint64_t settings;
  // The modules that are to run, a `COTAMA_CONFIGURATION_...`; `COTAMA_NONE` where nothing does.
  uint32_t configuration;
  // Motion may be commanded.
  bool drive;
  // Motor power is to be cut for good.
  bool halt;
  // The operator is asked.
  bool ask;
  // The mission was given up and the robot stands: alarm.
  bool alarm;
} cotama_requests;

// A text of so many bytes, with no zero at the end: `printf("%.*s", (int)it.length, it.bytes)`.
typedef struct cotama_text {
  // Start of the text; it stays there as long as the program runs.
  const char *bytes;
  // How many bytes it has.
  size_t length;
} cotama_text;

// A counter of milliseconds of 32 bits, which begins anew after 49.7 days, on its way to times of
// 64 bits, which do not: `cotama_ticks ticks = {first_count};`
typedef struct cotama_ticks {
  // The latest time, ms: at first the first count.
  uint64_t latest_ms;
} cotama_ticks;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library: the major number times 65,536, and the minor one times 256, and the
// patch.
uint32_t cotama_version(void);

// Plans by the rule of PANORAMA (Lambert et al. 2024), in memory of `COTAMA_RULE_BYTES` bytes.
//
// `plan` has room for a number of each activity: the place of its candidate among those of the
// activity. It is written when the verdict is `COTAMA_VERDICT_PLANNED`. The memory is free again
// afterwards, and none of it may overlap the problem, the plan or the answer, nor they each other.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given.
cotama_error cotama_plan_by_rule(const struct cotama_problem *problem,
                                 void *memory,
                                 size_t bytes,
                                 uint16_t *plan,
                                 size_t plan_length,
                                 struct cotama_answer *answer);

// Plans exactly, for up to `COTAMA_OBJECTIVES` of `cotama_objective` in lexicographic order, in
// memory of `COTAMA_EXACT_BYTES` bytes and at most `steps` steps.
//
// Without an objective any plan within the limits will do. The rest is as for
// `cotama_plan_by_rule`.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given.
cotama_error cotama_plan_exactly(const struct cotama_problem *problem,
                                 const uint32_t *objectives,
                                 size_t objective_count,
                                 uint64_t steps,
                                 void *memory,
                                 size_t bytes,
                                 uint16_t *plan,
                                 size_t plan_length,
                                 struct cotama_answer *answer);

// Returns the text of an error, in English, ended by a zero. Never null.
const char *cotama_error_text(int32_t error);

// Starts the level of a robot at rest, all of which works, in `bytes` bytes of memory, which are
// its from now on.
//
// `robot` is `COTAMA_ROBOT`; a header of another robot or mission is refused.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given.
cotama_error cotama_level_start(void *memory,
                                size_t bytes,
                                uint64_t robot,
                                struct cotama_level **level);

// Observers tell what they see. New flags are taken for failures, which wait to be told.
//
// `failures` may be null.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the level.
cotama_error cotama_level_perceive(struct cotama_level *level,
                                   uint64_t now_ms,
                                   const struct cotama_perceived *seen,
                                   struct cotama_failures *failures);

// Lets a failure that no flag shows, such as that no plan is left, wait to be told: a
// `COTAMA_FAILURE_...`.
//
// # Safety
// The pointer is null or points to a level that no other thread uses.
cotama_error cotama_level_report(struct cotama_level *level, uint32_t failure);

// Whether what is said in the coming round is heard: reports go first.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the level.
cotama_error cotama_level_listens(const struct cotama_level *level, bool *listens);

// A round: the supervisors take their turns, and are told one thing: the oldest report, else what
// the drive shows, else what is said. It is not heard unless the level listens.
//
// `said` may be null, which says nothing, as do `round` and `firings`, which nobody wants then.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the level.
cotama_error cotama_level_round(struct cotama_level *level,
                                uint64_t now_ms,
                                const struct cotama_told *said,
                                const struct cotama_drive *drive,
                                struct cotama_round *round,
                                struct cotama_firings *firings);

// The requests to the robot until the next round.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the level.
cotama_error cotama_level_requests(const struct cotama_level *level,
                                   uint64_t now_ms,
                                   struct cotama_requests *requests);

// Stores the supervisors in `COTAMA_LEVEL_STORED_BYTES` bytes with a checksum; `written` may be
// null.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given; no other thread
// uses the level.
cotama_error cotama_level_store(const struct cotama_level *level,
                                uint8_t *bytes,
                                size_t room,
                                size_t *written);

// Starts a level at `now_ms` where stored supervisors were. Flags that are still raised, reports
// that were not told and settings are forgotten: observers tell again what they see.
//
// `robot` is `COTAMA_ROBOT`.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given.
cotama_error cotama_level_restore(void *memory,
                                  size_t bytes,
                                  uint64_t robot,
                                  uint64_t now_ms,
                                  const uint8_t *stored,
                                  size_t length,
                                  struct cotama_level **level);

// The names of a net of the level and of one of its transitions, as in a firing.
//
// # Safety
// The pointers are null or point to memory for texts.
cotama_error cotama_level_transition_names(uint32_t net,
                                           uint32_t transition,
                                           struct cotama_text *net_name,
                                           struct cotama_text *transition_name);

// Starts a monitor of these inclusive limits, with nothing used, that never asks for a better
// plan; `order` are the axes in their order of treatment.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given; `limits` and
// `order` to `COTAMA_AXES` numbers each. The memory is the monitor's from now on.
cotama_error cotama_monitor_start(void *memory,
                                  size_t bytes,
                                  const uint64_t *limits,
                                  const uint32_t *order,
                                  struct cotama_monitor **monitor);

// Asks for a better plan too: when some margin has grown by `growth` since the last plan (0: not
// on this axis), with `reserve` left on each.
//
// # Safety
// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
// thread uses the monitor.
cotama_error cotama_monitor_ask_upward(struct cotama_monitor *monitor,
                                       const uint64_t *growth,
                                       const uint64_t *reserve);

// Notes that hardware has come back: a reason to ask for a better plan.
//
// # Safety
// The pointer is null or points to a monitor that no other thread uses.
cotama_error cotama_monitor_hardware_returned(struct cotama_monitor *monitor);

// Notes that a plan which will cost `rest` is in force from now on.
//
// # Safety
// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
// thread uses the monitor.
cotama_error cotama_monitor_planned(struct cotama_monitor *monitor,
                                    const uint64_t *rest);

// Adds what was used.
//
// # Safety
// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
// thread uses the monitor.
cotama_error cotama_monitor_spend(struct cotama_monitor *monitor,
                                  const uint64_t *cost);

// The rest of each limit: the limits of the next problem.
//
// # Safety
// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
// thread uses the monitor.
cotama_error cotama_monitor_left(const struct cotama_monitor *monitor,
                                 uint64_t *left);

// The margins: limit less used less what is planned for the rest, on each axis.
//
// # Safety
// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
// thread uses the monitor.
cotama_error cotama_monitor_margins(const struct cotama_monitor *monitor,
                                    const uint64_t *rest,
                                    int64_t *margins);

// Whether the plan still holds, from what it will cost, the units that it needs and those that
// there are. `axis` is the one whose margin is below zero, else `COTAMA_NONE`; it may be null.
//
// # Safety
// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
// thread uses the monitor.
cotama_error cotama_monitor_assess(const struct cotama_monitor *monitor,
                                   const uint64_t *rest,
                                   uint64_t needs,
                                   uint64_t available,
                                   cotama_request *request,
                                   uint32_t *axis);

// The name of a `COTAMA_FLAG_...` in print.
//
// # Safety
// The pointer is null or points to memory for a text.
cotama_error cotama_flag_name(uint32_t flag, struct cotama_text *name);

// The name of a `COTAMA_MODULE_...` in print.
//
// # Safety
// The pointer is null or points to memory for a text.
cotama_error cotama_module_name(uint32_t module, struct cotama_text *name);

// The name of a `COTAMA_SUB_OBJECTIVE_...` in print.
//
// # Safety
// The pointer is null or points to memory for a text.
cotama_error cotama_sub_objective_name(uint32_t sub_objective, struct cotama_text *name);

// The name of a `COTAMA_CONFIGURATION_...` in print.
//
// # Safety
// The pointer is null or points to memory for a text.
cotama_error cotama_configuration_name(uint32_t configuration, struct cotama_text *name);

// The name of a `COTAMA_FAILURE_...` in print.
//
// # Safety
// The pointer is null or points to memory for a text.
cotama_error cotama_failure_name(uint32_t failure, struct cotama_text *name);

// The name of a `COTAMA_REPORT_...` in print: that of its first failure.
//
// # Safety
// The pointer is null or points to memory for a text.
cotama_error cotama_report_name(uint32_t report, struct cotama_text *name);

// The name of a `COTAMA_LOSS_...` in print.
//
// # Safety
// The pointer is null or points to memory for a text.
cotama_error cotama_loss_name(uint32_t loss, struct cotama_text *name);

// The time of a count, ms: the nearest to the latest one that has these low 32 bits.
//
// A count that was read before another one and is told after it has its own, earlier time. Ask at
// least every 24 days. Ticks of another length are widened in the same way, to ticks.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the ticks.
cotama_error cotama_ticks_widen(struct cotama_ticks *ticks,
                                uint32_t count,
                                uint64_t *now_ms);

// Starts a watchdog at `now_ms` in `bytes` bytes of memory, which are its from now on.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given.
cotama_error cotama_watchdog_start(void *memory,
                                   size_t bytes,
                                   uint64_t now_ms,
                                   struct cotama_watchdog **watchdog);

// Lets time pass up to `now_ms`, then offers a `cotama_watchdog_event`.
//
// `outcome` and `firings` may be null.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the watchdog.
cotama_error cotama_watchdog_offer(struct cotama_watchdog *watchdog,
                                   uint64_t now_ms,
                                   uint32_t event,
                                   cotama_outcome *outcome,
                                   struct cotama_firings *firings);

// Lets time pass up to `now_ms`: what was due fires at the time when it was due.
//
// `behind` is set when there is more to catch up with: call again. It and `firings` may be null.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the watchdog.
cotama_error cotama_watchdog_advance(struct cotama_watchdog *watchdog,
                                     uint64_t now_ms,
                                     bool *behind,
                                     struct cotama_firings *firings);

// When the watchdog wants to be woken, ms; `COTAMA_NEVER` when nothing is due by itself.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the watchdog.
cotama_error cotama_watchdog_wake_at(const struct cotama_watchdog *watchdog, uint64_t *at_ms);

// How far `now_ms` lies before the time that the watchdog was last told, ms; 0 when it does not.
//
// A clock that goes back is no error of `cotama_watchdog_offer` and `cotama_watchdog_advance`:
// time stands still until the clock has caught up. Ask before them.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the watchdog.
cotama_error cotama_watchdog_went_back(const struct cotama_watchdog *watchdog,
                                       uint64_t now_ms,
                                       uint64_t *back_ms);

// The marked one of the first four of `cotama_watchdog_place`.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the watchdog.
cotama_error cotama_watchdog_state(const struct cotama_watchdog *watchdog, uint32_t *place);

// The tokens of a `cotama_watchdog_place`.
//
// # Safety
// The pointers are null or point to what their types say; no other thread uses the watchdog.
cotama_error cotama_watchdog_tokens(const struct cotama_watchdog *watchdog,
                                    uint32_t place,
                                    uint32_t *tokens);

// Stores the watchdog in `COTAMA_WATCHDOG_STORED_BYTES` bytes with a checksum; `written` may be
// null.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given; no other thread
// uses the watchdog.
cotama_error cotama_watchdog_store(const struct cotama_watchdog *watchdog,
                                   uint8_t *bytes,
                                   size_t room,
                                   size_t *written);

// Starts a watchdog at `now_ms` where a stored one was, with what its clocks had left.
//
// # Safety
// The pointers are null or point to what their types say, of the lengths given.
cotama_error cotama_watchdog_restore(void *memory,
                                     size_t bytes,
                                     uint64_t now_ms,
                                     const uint8_t *stored,
                                     size_t length,
                                     struct cotama_watchdog **watchdog);

// The name of a transition in a firing.
//
// # Safety
// The pointer is null or points to memory for a text.
cotama_error cotama_watchdog_transition_name(uint32_t transition, struct cotama_text *name);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* COTAMA_H */

/* Bytes for planning so many activities and candidates, by the rule and exactly. */
#define COTAMA_RULE_BYTES(activities, candidates) \
  ((activities) * COTAMA_RULE_ACTIVITY_BYTES + (candidates) * COTAMA_RULE_CANDIDATE_BYTES + \
   COTAMA_PLANNING_BYTES)
#define COTAMA_EXACT_BYTES(activities, candidates) \
  ((activities) * COTAMA_EXACT_ACTIVITY_BYTES + (candidates) * COTAMA_EXACT_CANDIDATE_BYTES + \
   COTAMA_PLANNING_BYTES)
