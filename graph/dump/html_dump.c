/* html_dump.c: dumps a plan as a self-contained HTML page that is also well-formed XML. */
#include "graph/dump/dump_internal.h"

/* CSS colours by resource usage, for light and dark mode. */
static const char colors[] =
    ":root{--back:#fff;--text:#1b1b1b;--line:#e3e3e3;--edge:#5a5a5a;--batch:#b3410e;\n"
    "--focus:#d0006f;--color:#a9cdee;--depth:#d3c1ea;--storage:#f6d393;--copy:#d2d2d2;\n"
    "--data:#b2e0ba}\n"
    "@media(prefers-color-scheme:dark){:root{--back:#16181b;--text:#ececec;--line:#33373c;\n"
    "--edge:#9a9a9a;--batch:#ff9a5c;--focus:#ff6bb5;--color:#264f73;--depth:#533f73;\n"
    "--storage:#6d4f14;--copy:#4a4a4a;--data:#2a5a35}}\n";

static const char style[] =
    "body{margin:1rem;background:var(--back);color:var(--text);\n"
    "font:14px/1.5 system-ui,sans-serif}\n"
    "h1{font-size:1.3rem;margin:0}\n"
    "h2{font-size:.95rem;position:sticky;left:0;width:max-content;margin:0;\n"
    "padding:.6rem .5rem .2rem}\n"
    "p{margin:.4rem 0}\n"
    "pre{margin:0;font-size:12px}\n"
    "b{padding:0 .5em;font-weight:normal;border:1px solid var(--edge)}\n"
    "main{overflow:auto;max-height:max(20rem,100vh - 18rem);border:1px solid var(--line);\n"
    "scroll-padding:16rem 1rem 1rem 14rem}\n"
    "svg{display:block;flex:none}\n"
    "text{font:11px system-ui,sans-serif;fill:var(--text)}\n"
    "rect{stroke:var(--edge)}\n"
    "details{margin-top:.6rem}\n"
    ".row{display:flex;width:max-content;border-top:1px solid var(--line)}\n"
    ".head{position:sticky;top:0;z-index:2;background:var(--back)}\n"
    ".axis{position:sticky;left:0;z-index:1;background:var(--back);\n"
    "border-right:1px solid var(--line)}\n"
    ".middle{text-anchor:middle}\n"
    ".end{text-anchor:end}\n"
    ".grid{fill:url(#grid);stroke:none}\n"
    ".line{stroke:var(--line)}\n"
    ".batches{stroke:var(--batch);stroke-dasharray:2 3}\n"
    ".batch *{stroke:var(--batch);stroke-width:1.5;fill:var(--back)}\n"
    ".batch text{stroke:none;fill:var(--text)}\n"
    ".color{fill:var(--color);background:var(--color)}\n"
    ".depth{fill:var(--depth);background:var(--depth)}\n"
    ".storage{fill:var(--storage);background:var(--storage)}\n"
    ".copy{fill:var(--copy);background:var(--copy)}\n"
    ".data{fill:var(--data);background:var(--data)}\n"
    ".technique{fill:var(--line)}\n"
    ".when rect{stroke-dasharray:3 2;stroke-width:2}\n"
    ".frames{fill-opacity:.3}\n"
    "g:focus{outline:none}\n"
    "g:focus rect,g:focus circle{stroke:var(--focus);stroke-width:3}\n"
    "#detail{position:sticky;bottom:0;height:8.5em;overflow:auto;padding:.5rem;z-index:3;\n"
    "background:var(--back);border:1px solid var(--line)}\n"
    "#detail[hidden]{display:none}\n";

/* JavaScript that also shows tooltips in a panel, for keyboard users and for long lists. */
static const char script[] =
    "const panel=document.getElementById('detail');panel.hidden=false;\n"
    "const show=event=>{const title=event.target.closest('g[tabindex]')?.querySelector('title');\n"
    "if(title)panel.textContent=title.textContent;};\n"
    "document.addEventListener('focusin',show);document.addEventListener('pointerover',show);\n";

static void html_name(FILE *out, const char *name)
{
    while (*name) {
        uint32_t c = rg_dump_printable(rg_dump_decode_utf8(&name));
        if (c == '&' || c == '<' || c == '>' || c == '"')
            fprintf(out, "&#%u;", c);
        else
            rg_dump_utf8(out, c);
    }
}

static void print_head(FILE *out)
{
    fputs("<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
          "<meta charset=\"utf-8\"/>\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
          "style-src 'unsafe-inline'; script-src 'unsafe-inline'\"/>\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
          "<meta name=\"color-scheme\" content=\"light dark\"/>\n"
          "<title>Render graph plan</title>\n",
          out);
    fprintf(out, "<style>\n%s%s</style>\n</head>\n<body>\n", colors, style);
}

static void print_faults(const struct rg_dump *d)
{
    rg_dump_print(d, "<h1>Faults: %u</h1>\n<ol>\n", d->plan->fault_count);
    for (uint32_t i = 0; i < d->plan->fault_count; i++) {
        char text[512];
        rg_fault_text(&d->plan->faults[i], text, sizeof(text));
        rg_dump_print(d, "<li>%n</li>\n", text);
    }
    rg_dump_print(d, "</ol>\n");
}

static void print_summary(const struct rg_dump *d)
{
    const struct rg_plan *plan = d->plan;
    rg_dump_print(d, "<h1>Plan for %ux%u</h1>\n<p id=\"summary\">", plan->view.width,
                  plan->view.height);
    rg_dump_print(d, "%u passes, %u culled; %u barriers in %u batches; ", plan->pass_count,
                  plan->culled_count, plan->barrier_count, plan->batch_count);
    rg_dump_print(d, "transient memory: used %b, without aliasing %b, bound %b", plan->memory_used,
                  plan->memory_without_aliasing, plan->memory_bound);
    if (plan->memory_least != plan->memory_bound)
        rg_dump_print(d, ", least %b if batches did not count", plan->memory_least);
    if (plan->memory_persistent)
        rg_dump_print(d, "; persistent memory: %b", plan->memory_persistent);
    rg_dump_print(
        d, "</p>\n"
           "<p><b class=\"color\">colour target, raster pass</b> <b class=\"depth\">depth</b> "
           "<b class=\"storage\">storage image, compute pass</b> <b class=\"copy\">other image, "
           "transfer pass</b> <b class=\"data\">buffer</b> circles: barriers of a batch; square: "
           "barriers before the first frame; dashed: conditional passes</p>\n");
}

void rg_dump_html(const struct rg_plan *plan, FILE *out)
{
    const struct rg_dump d = { plan, out, html_name };
    print_head(out);
    if (plan->fault_count) {
        print_faults(&d);
    } else {
        print_summary(&d);
        rg_dump_chart(&d);
        rg_dump_print(
            &d, "<pre id=\"detail\" role=\"status\" hidden=\"hidden\">Hover over an item, or "
                "select it with Tab.</pre>\n<details>\n<summary>Plan as text</summary>\n<pre>");
        rg_dump_text(&d);
        rg_dump_print(&d, "</pre>\n</details>\n<script>\n%s</script>\n", script);
    }
    rg_dump_print(&d, "</body>\n</html>\n");
}
