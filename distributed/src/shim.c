/* What ffi.rs needs of PETSc and MPI, with their macros and types left on this side. Every function returns 0, or the
   error code of PETSc or MPI. */
#include <petscksp.h>
#include <stdint.h>
#include <stdlib.h>

int ss_begin(int *rank, int *size) {
    PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
    PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, rank));
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, size));
    return 0;
}
int ss_end(void) { return PetscFinalize(); }
void ss_abort(int code) { MPI_Abort(MPI_COMM_WORLD, code); }
int ss_sum(double *x, int n) { return MPI_Allreduce(MPI_IN_PLACE, x, n, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD); }
int ss_max(double *x, int n) { return MPI_Allreduce(MPI_IN_PLACE, x, n, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD); }
int ss_all_to_all(const int *send_counts, const uint64_t *send, const int *send_starts, const int *receive_counts,
                  uint64_t *receive, const int *receive_starts) {
    return MPI_Alltoallv(send, send_counts, send_starts, MPI_UINT64_T, receive, receive_counts, receive_starts,
                         MPI_UINT64_T, PETSC_COMM_WORLD);
}
int ss_counts(const int *send, int *receive) {
    return MPI_Alltoall(send, 1, MPI_INT, receive, 1, MPI_INT, PETSC_COMM_WORLD);
}
/* Values to and from each neighbour, one after the other; `requests` has room for two a neighbour. */
size_t ss_request_size(void) { return sizeof(MPI_Request); }
int ss_exchange(int n, const int *ranks, const int *send_counts, const double *send, const int *receive_counts,
                double *receive, void *requests) {
    MPI_Request *request = requests;
    for (int k = 0; k < n; k++) {
        PetscCallMPI(MPI_Irecv(receive, receive_counts[k], MPI_DOUBLE, ranks[k], 7, PETSC_COMM_WORLD, request++));
        receive += receive_counts[k];
    }
    for (int k = 0; k < n; k++) {
        PetscCallMPI(MPI_Isend(send, send_counts[k], MPI_DOUBLE, ranks[k], 7, PETSC_COMM_WORLD, request++));
        send += send_counts[k];
    }
    PetscCallMPI(MPI_Waitall(2 * n, requests, MPI_STATUSES_IGNORE));
    return 0;
}

/* Conjugate gradients on a truncated Newton matrix Q B Q + H, preconditioned by Q' G Q' + J, G a multigrid cycle for
   B. H and J are blocks on the diagonal at some vertices, Q and Q' leave components out. */
typedef struct {
    PetscInt c, count;
    Mat b, a;
    KSP ksp;
    PC inner;
    Vec kept, smooth, work, load, x;
    PetscInt *vertices;
    double *hessians, *inverses;
} Krylov;

static PetscErrorCode add_blocks(Krylov *k, const double *blocks, Vec x, Vec y) {
    const double *from;
    double *to;
    PetscInt c = k->c;
    PetscCall(VecGetArrayRead(x, &from));
    PetscCall(VecGetArray(y, &to));
    for (PetscInt n = 0; n < k->count; n++)
        for (PetscInt j = 0; j < c; j++)
            for (PetscInt i = 0; i < c; i++)
                to[k->vertices[n] * c + i] += blocks[(n * c + j) * c + i] * from[k->vertices[n] * c + j];
    PetscCall(VecRestoreArray(y, &to));
    PetscCall(VecRestoreArrayRead(x, &from));
    return 0;
}
static PetscErrorCode newton_product(Mat a, Vec x, Vec y) {
    Krylov *k;
    PetscCall(MatShellGetContext(a, &k));
    PetscCall(MatMult(k->b, x, y));
    PetscCall(VecPointwiseMult(y, y, k->kept));
    return add_blocks(k, k->hessians, x, y);
}
static PetscErrorCode precondition(PC pc, Vec x, Vec y) {
    Krylov *k;
    PetscCall(PCShellGetContext(pc, (void **)&k));
    PetscCall(VecPointwiseMult(k->work, x, k->smooth));
    PetscCall(PCApply(k->inner, k->work, y));
    PetscCall(VecPointwiseMult(y, y, k->smooth));
    return add_blocks(k, k->inverses, x, y);
}
int ss_krylov_free(Krylov *k) {
    PetscCall(KSPDestroy(&k->ksp));
    PetscCall(PCDestroy(&k->inner));
    PetscCall(MatDestroy(&k->a));
    PetscCall(MatDestroy(&k->b));
    Vec *vectors[] = {&k->kept, &k->smooth, &k->work, &k->load, &k->x};
    for (int n = 0; n < 5; n++) PetscCall(VecDestroy(vectors[n]));
    free(k->vertices), free(k->hessians), free(k->inverses), free(k);
    return 0;
}
/* Rows of c x c blocks, column-major each, by global numbers of vertices. */
int ss_krylov_new(int c, int owned, int dimension, const double *points, const int *starts, const int *columns,
                  int first, const double *values, const int *vertices, int count, Krylov **out) {
    Krylov *k = calloc(1, sizeof(Krylov));
    PetscInt *diagonal = calloc(owned + 1, sizeof(PetscInt)), *off = calloc(owned + 1, sizeof(PetscInt));
    *out = k;
    k->c = c, k->count = count;
    k->vertices = malloc(sizeof(PetscInt) * (count + 1));
    k->hessians = calloc((size_t)c * c * count + 1, sizeof(double));
    k->inverses = calloc((size_t)c * c * count + 1, sizeof(double));
    for (int n = 0; n < count; n++) k->vertices[n] = vertices[n];
    for (int i = 0; i < owned; i++)
        for (int e = starts[i]; e < starts[i + 1]; e++)
            (columns[e] >= first && columns[e] < first + owned ? diagonal : off)[i]++;
    PetscCall(MatCreate(PETSC_COMM_WORLD, &k->b));
    PetscCall(MatSetSizes(k->b, c * owned, c * owned, PETSC_DECIDE, PETSC_DECIDE));
    PetscCall(MatSetBlockSize(k->b, c));
    PetscCall(MatSetType(k->b, MATAIJ));
    PetscCall(MatXAIJSetPreallocation(k->b, c, diagonal, off, NULL, NULL));
    PetscCall(MatSetOption(k->b, MAT_ROW_ORIENTED, PETSC_FALSE));
    for (int i = 0; i < owned; i++)
        for (int e = starts[i]; e < starts[i + 1]; e++) {
            PetscInt row = first + i, column = columns[e];
            PetscCall(MatSetValuesBlocked(k->b, 1, &row, 1, &column, values + (size_t)e * c * c, INSERT_VALUES));
        }
    free(diagonal), free(off);
    PetscCall(MatAssemblyBegin(k->b, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(k->b, MAT_FINAL_ASSEMBLY));
    PetscCall(MatSetOption(k->b, MAT_SPD, PETSC_TRUE));
    PetscCall(MatCreateVecs(k->b, &k->x, &k->load));
    PetscCall(VecDuplicate(k->x, &k->work));
    PetscCall(VecDuplicate(k->x, &k->kept));
    PetscCall(VecDuplicate(k->x, &k->smooth));
    if (c == dimension) {
        MatNullSpace rigid;
        double *to;
        PetscCall(VecGetArray(k->x, &to));
        for (int n = 0; n < c * owned; n++) to[n] = points[n];
        PetscCall(VecRestoreArray(k->x, &to));
        PetscCall(MatNullSpaceCreateRigidBody(k->x, &rigid));
        PetscCall(MatSetNearNullSpace(k->b, rigid));
        PetscCall(MatNullSpaceDestroy(&rigid));
    }
    PetscCall(PCCreate(PETSC_COMM_WORLD, &k->inner));
    PetscCall(PCSetType(k->inner, PCGAMG));
    PetscCall(PCSetOperators(k->inner, k->b, k->b));
    PetscCall(PCSetOptionsPrefix(k->inner, "tnnmg_"));
    PetscCall(PCSetFromOptions(k->inner));
    PetscCall(PCSetUp(k->inner));
    PetscCall(MatCreateShell(PETSC_COMM_WORLD, c * owned, c * owned, PETSC_DECIDE, PETSC_DECIDE, k, &k->a));
    PetscCall(MatShellSetOperation(k->a, MATOP_MULT, (void (*)(void))newton_product));
    PetscCall(KSPCreate(PETSC_COMM_WORLD, &k->ksp));
    PetscCall(KSPSetType(k->ksp, KSPCG));
    PetscCall(KSPSetNormType(k->ksp, KSP_NORM_NATURAL));
    PetscCall(KSPSetOperators(k->ksp, k->a, k->a));
    PC outer;
    PetscCall(KSPGetPC(k->ksp, &outer));
    PetscCall(PCSetType(outer, PCSHELL));
    PetscCall(PCShellSetContext(outer, k));
    PetscCall(PCShellSetApply(outer, precondition));
    return 0;
}
static PetscErrorCode fill(Vec v, const double *from) {
    PetscInt n;
    double *to;
    PetscCall(VecGetLocalSize(v, &n));
    PetscCall(VecGetArray(v, &to));
    for (PetscInt i = 0; i < n; i++) to[i] = from[i];
    PetscCall(VecRestoreArray(v, &to));
    return 0;
}
int ss_krylov_linearize(Krylov *k, const double *kept, const double *smooth, const double *hessians,
                        const double *inverses) {
    PetscCall(fill(k->kept, kept));
    PetscCall(fill(k->smooth, smooth));
    for (PetscInt n = 0; n < k->c * k->c * k->count; n++)
        k->hessians[n] = hessians[n], k->inverses[n] = inverses[n];
    return 0;
}
/* The solution of a load without entries that are left out, from zero. `error` is the norm in which it stopped,
   negative where the iteration broke down. */
int ss_krylov_solve(Krylov *k, const double *load, double *x, double relative, double absolute, int most,
                    int *iterations, double *error) {
    KSPConvergedReason reason;
    PetscInt n;
    const double *from;
    PetscCall(fill(k->load, load));
    PetscCall(KSPSetTolerances(k->ksp, relative, absolute, PETSC_DEFAULT, most));
    PetscCall(KSPSolve(k->ksp, k->load, k->x));
    PetscCall(KSPGetConvergedReason(k->ksp, &reason));
    PetscCall(KSPGetIterationNumber(k->ksp, &n));
    PetscCall(KSPGetResidualNorm(k->ksp, error));
    if (reason < 0 && reason != KSP_DIVERGED_ITS) *error = -1.0;
    *iterations = n;
    PetscCall(VecGetLocalSize(k->x, &n));
    PetscCall(VecGetArrayRead(k->x, &from));
    for (PetscInt i = 0; i < n; i++) x[i] = from[i];
    PetscCall(VecRestoreArrayRead(k->x, &from));
    return 0;
}
