/* farm_script.c: generates readable shell scripts for Slurm and GNU parallel. */
#include "src/app/farm_script.h"
#include <stdlib.h>
#include "src/base/shell_quote.h"
#include "src/base/text_stream.h"

/* Prints the arguments for firn render, without those that only firn farm has. */
static void print_arguments(const struct farm_script *script, FILE *out)
{
    app_print_render_arguments(script->options->run.args + 1, APP_FARM, 1, out);
}

static void print_program(const struct farm_script *script, const char *command, FILE *out)
{
    shell_quote_word(script->program, out);
    fprintf(out, " %s", command);
}

static void print_head(const struct farm_script *script, FILE *out)
{
    fprintf(out,
            "#!/bin/sh\n"
            "# %u frame%s in %u task%s. Running it again keeps the frames that are complete.\n"
            "set -eu\n"
            "mkdir -p %s.logs\n\n",
            script->frame_count, script->frame_count > 1 ? "s" : "", script->task_count,
            script->task_count > 1 ? "s" : "", script->name);
}

/* ---- Slurm ---- */

static void print_sbatch(const struct farm_script *script, FILE *out)
{
    for (uint32_t i = 0; i < script->options->farm.sbatch_count; i++)
        fprintf(out, "#SBATCH %s\n", script->options->farm.sbatch[i]);
}

void farm_script_slurm(const struct farm_script *script, FILE *out)
{
    print_head(script, out);
    fprintf(out,
            "job=$(sbatch --parsable <<'END'\n"
            "#!/bin/sh\n"
            "#SBATCH --job-name=%s\n"
            "#SBATCH --array=1-%u\n"
            "#SBATCH --requeue\n"
            "#SBATCH --open-mode=append\n"
            "#SBATCH --output=%s.logs/%%A_%%a.log\n"
            "#SBATCH --signal=USR1@60\n",
            script->name, script->task_count, script->name);
    print_sbatch(script, out);
    /* since Slurm 22.05, srun does not inherit --cpus-per-task from sbatch */
    fprintf(out, "[ -z \"$SLURM_CPUS_PER_TASK\" ] || "
                 "export SRUN_CPUS_PER_TASK=\"$SLURM_CPUS_PER_TASK\"\nsrun ");
    print_program(script, "render --resume --chunk ", out);
    fprintf(out, "\"$SLURM_ARRAY_TASK_ID/%u\" \\\n   ", script->task_count);
    print_arguments(script, out);
    fprintf(out,
            "\ncode=$?\n"
            "# 75: temporary failure; retry. Slurm sends SIGUSR1 60 s before the time limit.\n"
            "if [ $code -eq 75 ] && [ \"${SLURM_RESTART_COUNT:-0}\" -lt 20 ]; then\n"
            "    scontrol requeue \"${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID\"\n"
            "fi\n"
            "exit $code\n"
            "END\n)\n"
            "echo \"job ${job%%%%;*}: %u tasks, logs in %s.logs\"\n\n",
            script->task_count, script->name);
    fprintf(out,
            "sbatch --parsable --dependency=\"afterany:${job%%%%;*}\" <<'END' >/dev/null\n"
            "#!/bin/sh\n"
            "#SBATCH --job-name=%s.status\n"
            "#SBATCH --output=%s.logs/status.log\n",
            script->name, script->name);
    print_sbatch(script, out);
    print_program(script, "farm status \\\n   ", out);
    print_arguments(script, out);
    fprintf(out, "\nEND\n");
}

/* ---- GNU parallel ---- */

/* Prints a task's command, quoted twice because GNU parallel passes it to another shell. */
static void print_line(const struct farm_script *script, FILE *out)
{
    struct text_stream stream;
    FILE *text = text_stream_open(&stream);
    if (text) {
        print_program(script, "render --resume --chunk ", text);
        fprintf(text, "{}/%u", script->task_count);
        print_arguments(script, text);
    }
    char *line = text_stream_close(&stream, NULL);
    if (line)
        shell_quote_word(line, out);
    free(line);
}

void farm_script_parallel(const struct farm_script *script, FILE *out)
{
    const char *hosts = script->options->farm.hosts;
    print_head(script, out);
    fprintf(out, "# Tasks of a host that does not answer are retried on the other hosts.\n: "
                 "\"${PARALLEL_SSH:=ssh -o BatchMode=yes -o ConnectTimeout=10}\"\nexport "
                 "PARALLEL_SSH\nparallel --sshlogin ");
    shell_quote_word(hosts ? hosts : ":", out);
    fprintf(out,
            " --workdir \"$PWD\" --jobs 1 --retries 4 \\\n"
            "    --joblog %s.logs/joblog --resume-failed \\\n    ",
            script->name);
    print_line(script, out);
    fprintf(out,
            " \\\n"
            "    ::: $(seq %u) </dev/null || echo \"tasks have failed: %s.logs/joblog\" >&2\n\n",
            script->task_count, script->name);
    print_program(script, "farm status \\\n   ", out);
    print_arguments(script, out);
    putc('\n', out);
}
