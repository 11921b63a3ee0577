/*
 * model_parser.h: assimp with the importers of one format alone, for C.
 *
 * Memory that is short ends the process by std::bad_alloc, as everywhere in assimp: the parent of a
 * reader process knows that word.
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_PARSER_H
#define FIRN_SCENE_IMPORT_MODEL_PARSER_H

#include <stdio.h>

struct aiScene;
struct model_parser;

/* Opens a file that the model is or names, for reading; NULL if it is not there or not allowed. */
typedef FILE *model_parser_open_fn(void *user, const char *path);

/* Returns a parser of files with a suffix in lower case, "glb"; NULL when out of memory. */
struct model_parser *model_parser_new(const char *suffix, model_parser_open_fn *open, void *user);

/* Reads a file; the scene is the parser's. On failure returns NULL. */
const struct aiScene *model_parser_read(struct model_parser *parser, const char *path);

/* Changes the scene by steps of aiPostProcessSteps. On failure returns NULL; the scene is gone. */
const struct aiScene *model_parser_process(struct model_parser *parser, unsigned steps);

/* Returns why the last call failed; valid until the next. */
const char *model_parser_error(const struct model_parser *parser);

/* `parser` may be NULL. */
void model_parser_delete(struct model_parser *parser);

#endif
