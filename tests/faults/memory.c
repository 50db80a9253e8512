/* Loaded into a program (LD_PRELOAD), runs its main many times, each time in a child of its own in which one allocation
   fails: the first, the second and so on until none is left to fail. What it takes is in the environment:

     FAULTS_OUT       the folder into which the program writes: made empty before each run
     FAULTS_WORK      a folder for what this program needs itself
     FAULTS_MOST      runs at most: of more allocations every one up to half of it, and then one in so many
     FAULTS_ALL       all allocations from the n-th on fail, not it alone
     FAULTS_AT        one run, in which this one fails, without all this: for a debugger
     FAULTS_AGAIN     what failed is run again in what it left, undisturbed: there must then be what a run leaves that
   nothing befell

   A run may end with exit code 71, and then says so and leaves nothing (unless FAULTS_AGAIN). It may end with 0, when a
   library does without what it did not get: then it leaves the same bytes, and prints the same, as a run that nothing
   befell. In JSON summaries, which hold times, numbers may differ; a table of timings knows nothing of what an earlier
   run did. Where main returns, no more blocks are held than then. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MEMORY = 71, SECONDS = 60, SHOWN = 10 };

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t),
    *__libc_memalign(size_t, size_t);
extern void __libc_free(void *);

static atomic_long count, held; /* allocations asked for since main began; blocks held that were got since then */
static long fails_at;           /* 0: none does */
static bool all, counts;

/* libsoxr 0.1.3 uses what it asks for without a look at whether it got it: of its allocations none fails
 * (src/num/resample.c asks for more just before). */
static bool soxr_crashes(const void *caller)
{
    Dl_info who;
    return dladdr(caller, &who) != 0 && who.dli_fname && strstr(who.dli_fname, "libsoxr");
}

/* Does this one fail? */
static bool fails(const void *caller)
{
    if (!counts) return false;
    long n = atomic_fetch_add(&count, 1) + 1;
    return fails_at > 0 && (n == fails_at || (all && n > fails_at)) && !soxr_crashes(caller);
}

static void *got(void *p)
{
    if (p && counts) atomic_fetch_add(&held, 1);
    return p;
}

static void *none(void)
{
    errno = ENOMEM;
    return NULL;
}

/* libsndfile 1.2 notes the chunks of a WAV that it reads in such a table, and uses it whether it got it or not: this
   one does not fail (src/file/wav.c asks for more just before). */
static bool sndfile_crashes(size_t n, size_t size) { return n == 20 && size == 96; }

void *malloc(size_t n) { return fails(__builtin_return_address(0)) ? none() : got(__libc_malloc(n)); }
void *calloc(size_t n, size_t size)
{
    return !sndfile_crashes(n, size) && fails(__builtin_return_address(0)) ? none() : got(__libc_calloc(n, size));
}
void *memalign(size_t to, size_t n)
{
    return fails(__builtin_return_address(0)) ? none() : got(__libc_memalign(to, n));
}
void *aligned_alloc(size_t to, size_t n) { return memalign(to, n); }

void *realloc(void *p, size_t n)
{
    if (!p) return fails(__builtin_return_address(0)) ? none() : got(__libc_malloc(n));
    return fails(__builtin_return_address(0)) ? none() : __libc_realloc(p, n);
}

int posix_memalign(void **p, size_t to, size_t n)
{
    void *q = memalign(to, n);
    if (!q) return ENOMEM;
    *p = q;
    return 0;
}

void free(void *p)
{
    if (p && counts) atomic_fetch_sub(&held, 1);
    __libc_free(p);
}

/* ------------------------------------------------------------------ one run */

typedef int main_of(int, char **, char **);

static struct program {
    main_of *main;
    int argc;
    char **argv, **environment;
} program;

static struct seen { /* by the parent too */
    long count, held;
    bool returned;
} * seen;

static char out[4096], want[4096], printed[4096], said[4096], printed_then[4096];

static int remove_one(const char *path, const struct stat *s, int type, struct FTW *where)
{
    (void)s, (void)type, (void)where;
    return remove(path);
}

static void empty(const char *folder)
{
    nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
    if (mkdir(folder, 0777) != 0) abort();
}

static void onto(int fd, const char *path)
{
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0 || dup2(file, fd) < 0 || close(file) != 0) abort();
}

static _Noreturn void child(long n)
{
    onto(1, printed);
    onto(2, said);
    alarm(SECONDS);
    fails_at = n;
    counts = true;
    int code = program.main(program.argc, program.argv, program.environment);
    *seen = (struct seen){count, held, true};
    counts = false;
    exit(code);
}

/* Its status as of waitpid. */
static int run(long n)
{
    int status;
    *seen = (struct seen){0};
    fflush(stdout); /* what is not written yet would be written by the child too */
    pid_t pid = fork();
    if (pid == 0) child(n);
    if (pid < 0 || waitpid(pid, &status, 0) != pid) abort();
    return status;
}

/* ------------------------------------------------------------------ what it left */

static char *slurp(const char *path, size_t *n)
{
    struct stat s;
    int fd = open(path, O_RDONLY);
    if (fd < 0 || fstat(fd, &s) != 0) abort();
    char *text = malloc((size_t)s.st_size + 1);
    ssize_t got_n = read(fd, text, (size_t)s.st_size);
    close(fd);
    *n = got_n < 0 ? 0 : (size_t)got_n;
    text[*n] = '\0';
    return text;
}

/* Takes out what numbers are made of. */
static size_t without_numbers(char *text, size_t n)
{
    size_t left = 0;
    for (size_t i = 0; i < n; i++)
        if (!strchr("0123456789.e+-", text[i])) text[left++] = text[i];
    return left;
}

static bool same(const char *a, const char *b, bool but_numbers)
{
    size_t n[2];
    char *x = slurp(a, &n[0]), *y = slurp(b, &n[1]);
    if (but_numbers) n[0] = without_numbers(x, n[0]), n[1] = without_numbers(y, n[1]);
    bool yes = n[0] == n[1] && memcmp(x, y, n[0]) == 0;
    free(x);
    free(y);
    return yes;
}

static bool ends(const char *name, const char *with)
{
    size_t n = strlen(name), m = strlen(with);
    return n >= m && strcmp(name + n - m, with) == 0;
}

static bool holds_times(const char *name) { return ends(name, ".json") && !ends(name, "manifest.json"); }

static char why[4400];

static bool because(const char *what, const char *path)
{
    snprintf(why, sizeof why, "%s%s", what, path);
    return false;
}

/* Everything in folder a is in folder b; contents: the same there. */
static bool within(const char *a, const char *b, bool contents)
{
    DIR *d = opendir(a);
    bool good = d != NULL;
    for (const struct dirent *f; good && (f = readdir(d));) {
        char in_a[2048], in_b[2048];
        struct stat s, t;
        if (strcmp(f->d_name, ".") == 0 || strcmp(f->d_name, "..") == 0) continue;
        snprintf(in_a, sizeof in_a, "%s/%s", a, f->d_name);
        snprintf(in_b, sizeof in_b, "%s/%s", b, f->d_name);
        if (lstat(in_a, &s) != 0 || lstat(in_b, &t) != 0 || S_ISDIR(s.st_mode) != S_ISDIR(t.st_mode))
            good = because("not there in both: ", in_a);
        else if (S_ISDIR(s.st_mode))
            good = within(in_a, in_b, contents);
        else if (contents && !ends(f->d_name, "timings.csv") && !same(in_a, in_b, holds_times(f->d_name)))
            good = because("other bytes: ", in_a);
    }
    if (d) closedir(d);
    return good;
}

static bool as_wanted(void)
{
    return within(out, want, true) && within(want, out, false) &&
           (same(printed, printed_then, false) || because("other text on standard output", ""));
}

static bool nothing_left(void) { return rmdir(out) == 0 || because("left something behind", ""); }

/* ------------------------------------------------------------------ judging */

static bool ended(int status, long held_then)
{
    size_t n;
    char *text = slurp(said, &n);
    bool speaks = strncmp(text, getenv("FAULTS_SAYS") ? getenv("FAULTS_SAYS") : "rasp",
                          getenv("FAULTS_SAYS") ? strlen(getenv("FAULTS_SAYS")) : 4) == 0 &&
                  strstr(text, "memory");
    free(text);
    if (WIFSIGNALED(status)) return because("signal ", strsignal(WTERMSIG(status)));
    if (seen->returned && seen->held > held_then)
        return because(seen->held > held_then + 1 ? "holds more blocks at its end than a run that nothing befell"
                                                  : "holds a block more at its end than a run that nothing befell",
                       "");
    if (WEXITSTATUS(status) == 0) return as_wanted();
    if (WEXITSTATUS(status) != MEMORY) {
        char code[16];
        snprintf(code, sizeof code, "%d", WEXITSTATUS(status));
        return because("exit code ", code);
    }
    return speaks || because("does not say that memory is out", "");
}

static void told(long n)
{
    size_t size;
    char *text = slurp(said, &size);
    printf("allocation %ld fails: %s\n    %.300s\n", n, why, text);
    free(text);
}

static bool one(long n, bool again, long held_then, long codes[256])
{
    empty(out);
    int status = run(n);
    bool good = ended(status, held_then) && (WEXITSTATUS(status) == 0 || again || nothing_left());
    codes[WIFEXITED(status) ? WEXITSTATUS(status) : 255]++;
    if (good && again && WEXITSTATUS(status) != 0)
        good = (run(0) == 0 || because("run again it fails", "")) && as_wanted();
    return good;
}

static int search(void)
{
    long most = atol(getenv("FAULTS_MOST") ? getenv("FAULTS_MOST") : "1000000000"), codes[256] = {0}, runs = 0, bad = 0;
    bool again = getenv("FAULTS_AGAIN") != NULL;
    empty(out);
    if (run(0) != 0 || !seen->returned) {
        why[0] = '\0';
        told(0);
        return 1;
    }
    struct seen then = *seen;
    if (rename(out, want) != 0 || rename(printed, printed_then) != 0) abort();
    long every = most / 2,
         stride = then.count > most && most > every ? (then.count - every + most - every - 1) / (most - every) : 1;
    for (long n = 1; n <= then.count; n += n < every ? 1 : stride, runs++)
        if (!one(n, again, then.held, codes) && bad++ < SHOWN) told(n);
    printf("%ld allocations, %ld runs: %ld done without, %ld out of memory, %ld wrong\n", then.count, runs, codes[0],
           codes[MEMORY], bad);
    return bad || codes[MEMORY] == 0;
}

static int instead(int argc, char **argv, char **environment)
{
    const char *work = getenv("FAULTS_WORK");
    program.argc = argc, program.argv = argv, program.environment = environment;
    if (getenv("FAULTS_AT")) {
        fails_at = atol(getenv("FAULTS_AT"));
        counts = true;
        return program.main(argc, argv, environment);
    }
    unsetenv("LD_PRELOAD");
    all = getenv("FAULTS_ALL") != NULL;
    seen = mmap(NULL, sizeof *seen, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    snprintf(out, sizeof out, "%s", getenv("FAULTS_OUT"));
    snprintf(want, sizeof want, "%s/want", work);
    snprintf(printed, sizeof printed, "%s/out", work);
    snprintf(said, sizeof said, "%s/err", work);
    snprintf(printed_then, sizeof printed_then, "%s/out.want", work);
    return search();
}

typedef int start_of(main_of *, int, char **, void (*)(void), void (*)(void), void (*)(void), void *);

int __libc_start_main(main_of *main, int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*loader)(void), void *stack)
{
    start_of *start = (start_of *)dlsym(RTLD_NEXT, "__libc_start_main");
    program.main = main;
    return start(instead, argc, argv, init, fini, loader, stack);
}
