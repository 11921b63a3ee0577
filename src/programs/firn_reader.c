/* firn_reader.c: entry point of firn-reader, which reads one file in a sandbox for a process that
 * uses the library. */
#include "src/base/log.h"
#include "src/scene/import/sandboxed_load.h"

int main(int argc, char **argv)
{
    if (reader_is_child(argc, argv))
        return sandboxed_load_main(argc, argv);
    log_error("firn-reader is started by programs that use libfirn, not by users");
    return STATUS_USAGE;
}
