/*
 * model_parser.cpp: assimp's importers. Its C interface cannot leave any out, so that a file with
 * any suffix could reach any of 50 parsers.
 */
#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOStream.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstring>
#include <new>
#include <string>
extern "C" {
#include "src/scene/import/model_parser.h"
}

namespace
{

class model_stream : public Assimp::DefaultIOStream
{
  public:
    model_stream(FILE *file, const std::string &path) : DefaultIOStream(file, path)
    {
    }
};

/* Opens what the caller's function allows, for reading. */
class model_files : public Assimp::IOSystem
{
  public:
    model_files(model_parser_open_fn *function, void *argument) : open(function), user(argument)
    {
    }

    bool Exists(const char *path) const override
    {
        FILE *file = open(user, path);
        if (file)
            fclose(file);
        return file != nullptr;
    }

    char getOsSeparator() const override
    {
        return '/';
    }

    Assimp::IOStream *Open(const char *path, const char *mode) override
    {
        FILE *file = mode[0] == 'r' ? open(user, path) : nullptr;
        return file ? new model_stream(file, path) : nullptr;
    }

    void Close(Assimp::IOStream *stream) override
    {
        delete stream;
    }

  private:
    model_parser_open_fn *open;
    void *user;
};

/* Whether a list, "gltf glb", has a word. */
bool has_word(const char *list, const char *word)
{
    const size_t size = strlen(word);
    for (const char *at = list; (at = strstr(at, word)); at += size) {
        if ((at == list || at[-1] == ' ') && (at[size] == ' ' || at[size] == '\0'))
            return true;
    }
    return false;
}

void keep_only(Assimp::Importer &importer, const char *suffix)
{
    for (size_t i = importer.GetImporterCount(); i-- > 0;) {
        Assimp::BaseImporter *one = importer.GetImporter(i);
        if (has_word(importer.GetImporterInfo(i)->mFileExtensions, suffix))
            continue;
        importer.UnregisterLoader(one);
        delete one;
    }
}

} // namespace

struct model_parser {
    Assimp::Importer importer;
    std::string error;
};

struct model_parser *model_parser_new(const char *suffix, model_parser_open_fn *open, void *user)
{
    try {
        model_parser *parser = new model_parser;
        keep_only(parser->importer, suffix);
        parser->importer.SetIOHandler(new model_files(open, user));
        return parser;
    } catch (const std::bad_alloc &) {
        return nullptr;
    }
}

const struct aiScene *model_parser_read(struct model_parser *parser, const char *path)
{
    const aiScene *scene = parser->importer.ReadFile(path, 0);
    parser->error = parser->importer.GetErrorString();
    return scene;
}

const struct aiScene *model_parser_process(struct model_parser *parser, unsigned steps)
{
    const aiScene *scene = parser->importer.ApplyPostProcessing(steps);
    parser->error = parser->importer.GetErrorString();
    return scene;
}

const char *model_parser_error(const struct model_parser *parser)
{
    return parser->error.c_str();
}

void model_parser_delete(struct model_parser *parser)
{
    delete parser;
}
