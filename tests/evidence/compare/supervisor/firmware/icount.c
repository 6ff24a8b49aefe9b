/* Counts the instructions of regions of an image that runs in QEMU: a TCG plugin.
 *
 *   gcc -O2 -fPIC -shared -o libicount.so icount.c
 *   qemu-system-arm ... -plugin ./libicount.so,mark=0xADDRESS -d plugin -D COUNTS
 *
 * ADDRESS is that of a function of the image. Its first call opens a region, the second closes it
 * and writes the number of instructions between them on a line, and so on.
 *
 * Declares what it uses of plugin interface 1 itself, since Debian has no package with the header.
 */
#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { NO_REGISTERS = 0, ADD_U64 = 0 };

void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t, void (*)(uint64_t, struct qemu_plugin_tb *));
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *, int, void *, uint64_t);
void qemu_plugin_register_vcpu_insn_exec_cb(
    struct qemu_plugin_insn *, void (*)(unsigned, void *), int, void *);
void qemu_plugin_outs(const char *);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

static uint64_t mark, executed, opened;
static int is_open;

static void on_mark(unsigned cpu, void *data)
{
    char line[32];

    (void)cpu, (void)data;
    if (is_open) {
        snprintf(line, sizeof line, "%" PRIu64 "\n", executed - opened);
        qemu_plugin_outs(line);
    }
    is_open = !is_open;
    opened = executed;
}

static void on_translation(uint64_t id, struct qemu_plugin_tb *block)
{
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); i++) {
        struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(block, i);

        if (qemu_plugin_insn_vaddr(insn) == mark)
            qemu_plugin_register_vcpu_insn_exec_cb(insn, on_mark, NO_REGISTERS, NULL);
        qemu_plugin_register_vcpu_insn_exec_inline(insn, ADD_U64, &executed, 1);
    }
}

__attribute__((visibility("default"))) int qemu_plugin_install(
    uint64_t id, const void *info, int argc, char **argv)
{
    (void)info;
    for (int i = 0; i < argc; i++)
        if (strncmp(argv[i], "mark=", 5) == 0)
            mark = strtoull(argv[i] + 5, NULL, 0) & ~UINT64_C(1);
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
    return 0;
}
