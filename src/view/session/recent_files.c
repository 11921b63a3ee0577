/* recent_files.c: list of recently opened files, kept in a short text file. */
#define _GNU_SOURCE /* for asprintf */
#include "src/view/session/recent_files.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/file/atomic_file.h"
#include "src/view/session/xdg_folders.h"

static char *file_name(bool make)
{
    char *folder = user_files_state(make);
    char *path = NULL;
    if (folder && asprintf(&path, "%s/recent", folder) < 0)
        path = NULL;
    free(folder);
    return path;
}

/* Returns the next line without newline, NULL at the end. The caller frees the line. */
static char *take_line(FILE *file)
{
    char *line = NULL;
    size_t size = 0;
    const ssize_t length = getline(&line, &size, file);
    if (length < 0) {
        free(line);
        return NULL;
    }
    if (length && line[length - 1] == '\n')
        line[length - 1] = '\0';
    return line;
}

/* Prints at most RECENT_FILES_COUNT lines: `first`, then lines of `before` that differ from it. */
static void print(FILE *out, const char *first, FILE *before)
{
    char *line;
    uint32_t count = 1;
    fprintf(out, "%s\n", first);
    while (before && count < RECENT_FILES_COUNT && (line = take_line(before))) {
        if (strcmp(line, first) != 0) {
            fprintf(out, "%s\n", line);
            count++;
        }
        free(line);
    }
}

void recent_files_add(const char *path)
{
    char *first = realpath(path, NULL);
    char *name = first && !strchr(first, '\n') ? file_name(true) : NULL;
    char *text = NULL;
    size_t size = 0;
    FILE *out = name ? open_memstream(&text, &size) : NULL;
    if (out) {
        FILE *before = fopen(name, "r");
        print(out, first, before);
        if (before)
            (void)fclose(before);
        if (fclose(out) == 0)
            (void)!file_io_write(name, text, size); /* errors are logged there */
    }
    free(text);
    free(name);
    free(first);
}

char *recent_files_at(uint32_t i)
{
    char *name = file_name(false);
    FILE *file = name ? fopen(name, "r") : NULL;
    char *line = NULL;
    while (file && (line = take_line(file))) {
        if (access(line, R_OK) == 0 && !i--)
            break;
        free(line);
    }
    if (file)
        (void)fclose(file);
    free(name);
    return line;
}
