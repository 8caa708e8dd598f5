/* What ffi.rs needs of PETSc and MPI, with their macros and types left on this side. Every function returns 0, or the
   error code of PETSc or MPI. */
#include <petscksp.h>
#include <stdint.h>
#include <stdlib.h>

#if defined(PETSC_USE_COMPLEX) || !defined(PETSC_USE_REAL_DOUBLE)
#error "PETSc has to be one of real numbers in double precision"
#endif

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

/* Multigrid for a matrix of c x c blocks, finest level first. On the coarsest one PETSc's algebraic multigrid, or a
   factor where it is small. The diagonals of some rows of each level change, and `stiff` is what is added there. */
enum { LEVELS = 32, FEW = 1000 };
typedef struct {
    PetscInt c, count, vertex_count, row_counts[LEVELS], *vertices, *rows[LEVELS];
    double *diagonals[LEVELS], *surpluses[LEVELS];
    /* What sweeps read in the place of the matrix, where they would diverge without. */
    Mat matrices[LEVELS], swept[LEVELS], interpolations[LEVELS];
    Vec free, points, in, out, stiff[LEVELS];
    KSP bottom;
    PC pc;
} Multigrid;

static PetscErrorCode fill(Vec v, const double *from) {
    PetscInt n;
    double *to;
    PetscCall(VecGetLocalSize(v, &n));
    PetscCall(VecGetArray(v, &to));
    for (PetscInt i = 0; i < n; i++) to[i] = from[i];
    PetscCall(VecRestoreArray(v, &to));
    return 0;
}
/* What vertices of a finer field leave to those of a coarser one at the same places. */
static PetscErrorCode inject(Vec *field, Vec to, PetscInt c, PetscInt count, const int *copies) {
    const double *from;
    double *values;
    PetscCall(VecGetArrayRead(*field, &from));
    PetscCall(VecGetArray(to, &values));
    for (PetscInt k = 0; k < count; k++)
        for (PetscInt i = 0; i < c; i++) values[c * k + i] = from[c * copies[k] + i];
    PetscCall(VecRestoreArray(to, &values));
    PetscCall(VecRestoreArrayRead(*field, &from));
    PetscCall(VecDestroy(field));
    *field = to;
    return 0;
}
/* The numbers of the components of frictional vertices, or ones. */
static PetscErrorCode stiffen_finest(Multigrid *m, const double *from) {
    double *to;
    PetscCall(VecGetArray(m->stiff[0], &to));
    for (PetscInt n = 0; n < m->vertex_count; n++)
        for (PetscInt i = 0; i < m->c; i++) to[m->c * m->vertices[n] + i] = from ? from[m->c * n + i] : 1.0;
    PetscCall(VecRestoreArray(m->stiff[0], &to));
    return 0;
}
int ss_multigrid_free(Multigrid *m) {
    PetscCall(PCDestroy(&m->pc));
    for (PetscInt l = 0; l < m->count; l++) {
        PetscCall(MatDestroy(&m->matrices[l]));
        PetscCall(MatDestroy(&m->swept[l]));
        PetscCall(MatDestroy(&m->interpolations[l]));
        PetscCall(VecDestroy(&m->stiff[l]));
        free(m->rows[l]), free(m->diagonals[l]), free(m->surpluses[l]);
    }
    free(m->vertices);
    Vec *vectors[] = {&m->free, &m->points, &m->in, &m->out};
    for (int n = 0; n < 4; n++) PetscCall(VecDestroy(vectors[n]));
    free(m);
    return 0;
}
/* A copy of a matrix that is stored by blocks, through which products and sweeps are faster. All entries of a block are
   there. */
static PetscErrorCode by_blocks(Mat a, PetscInt c, Mat *copy) {
    PetscInt size, begin, n;
    const PetscInt *columns;
    const double *values;
    Mat b;
    PetscCall(MatGetLocalSize(a, &size, NULL));
    PetscCall(MatGetOwnershipRange(a, &begin, NULL));
    PetscInt *diagonal = calloc(size + 1, sizeof(PetscInt)), *off = calloc(size + 1, sizeof(PetscInt)), longest = 0;
    for (PetscInt i = 0; i < size; i += c) {
        PetscCall(MatGetRow(a, begin + i, &n, &columns, NULL));
        for (PetscInt e = 0; e < n; e += c) (columns[e] >= begin && columns[e] < begin + size ? diagonal : off)[i / c]++;
        if (n > longest) longest = n;
        PetscCall(MatRestoreRow(a, begin + i, &n, &columns, NULL));
    }
    PetscCall(MatCreate(PETSC_COMM_WORLD, &b));
    PetscCall(MatSetSizes(b, size, size, PETSC_DECIDE, PETSC_DECIDE));
    PetscCall(MatSetBlockSize(b, c));
    PetscCall(MatSetType(b, MATBAIJ));
    PetscCall(MatXAIJSetPreallocation(b, c, diagonal, off, NULL, NULL));
    double *block_row = malloc(sizeof(double) * c * (longest + 1));
    PetscInt *places = malloc(sizeof(PetscInt) * (longest + 1));
    for (PetscInt i = 0; i < size; i += c) {
        PetscInt row = (begin + i) / c, count = 0;
        for (PetscInt r = 0; r < c; r++) {
            PetscCall(MatGetRow(a, begin + i + r, &n, &columns, &values));
            for (PetscInt e = 0; e < n; e++) block_row[r * n + e] = values[e];
            for (count = 0; count < n / c; count++) places[count] = columns[c * count] / c;
            PetscCall(MatRestoreRow(a, begin + i + r, &n, &columns, &values));
        }
        PetscCall(MatSetValuesBlocked(b, 1, &row, count, places, block_row, INSERT_VALUES));
    }
    free(diagonal), free(off), free(block_row), free(places);
    PetscCall(MatAssemblyBegin(b, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(b, MAT_FINAL_ASSEMBLY));
    *copy = b;
    return 0;
}
/* The finest level: rows of c x c blocks, column-major each, by global numbers of vertices. Components that are not free
   are coupled with no other. Points are NULL where the kernel of the operator is none of rigid motions. */
int ss_multigrid_new(int c, int owned, const double *points, const double *free_components, const int *starts,
                     const int *columns, int first, const double *values, const int *vertices, int vertex_count,
                     Multigrid **out) {
    Multigrid *m = calloc(1, sizeof(Multigrid));
    PetscInt *diagonal = calloc(owned + 1, sizeof(PetscInt)), *off = calloc(owned + 1, sizeof(PetscInt));
    Mat b;
    *out = m;
    m->c = c;
    for (int i = 0; i < owned; i++)
        for (int e = starts[i]; e < starts[i + 1]; e++)
            (columns[e] >= first && columns[e] < first + owned ? diagonal : off)[i]++;
    PetscCall(MatCreate(PETSC_COMM_WORLD, &b));
    PetscCall(MatSetSizes(b, c * owned, c * owned, PETSC_DECIDE, PETSC_DECIDE));
    PetscCall(MatSetBlockSize(b, c));
    PetscCall(MatSetType(b, MATAIJ));
    PetscCall(MatXAIJSetPreallocation(b, c, diagonal, off, NULL, NULL));
    PetscCall(MatSetOption(b, MAT_ROW_ORIENTED, PETSC_FALSE));
    for (int i = 0; i < owned; i++)
        for (int e = starts[i]; e < starts[i + 1]; e++) {
            PetscInt row = first + i, column = columns[e];
            PetscCall(MatSetValuesBlocked(b, 1, &row, 1, &column, values + (size_t)e * c * c, INSERT_VALUES));
        }
    free(diagonal), free(off);
    PetscCall(MatAssemblyBegin(b, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(b, MAT_FINAL_ASSEMBLY));
    PetscCall(MatSetOption(b, MAT_SPD, PETSC_TRUE));
    m->matrices[m->count++] = b;
    PetscCall(VecCreateMPIWithArray(PETSC_COMM_WORLD, c, c * owned, PETSC_DECIDE, NULL, &m->in));
    PetscCall(VecDuplicate(m->in, &m->out));
    PetscCall(MatCreateVecs(b, &m->free, NULL));
    PetscCall(fill(m->free, free_components));
    if (points) {
        PetscCall(VecDuplicate(m->free, &m->points));
        PetscCall(fill(m->points, points));
    }
    m->vertex_count = vertex_count;
    m->vertices = malloc(sizeof(PetscInt) * (vertex_count + 1));
    for (int n = 0; n < vertex_count; n++) m->vertices[n] = vertices[n];
    PetscCall(VecDuplicate(m->free, &m->stiff[0]));
    PetscCall(stiffen_finest(m, NULL));
    return 0;
}
/* A coarser level of `owned` vertices, those at the places of `copies`: for each component of each vertex of the last
   level the components it is interpolated from, and their weights. Components that are not free interpolate nothing and
   are not interpolated. */
int ss_multigrid_coarsen(Multigrid *m, int owned, int first, const int *copies, const int *starts, const int *columns,
                         const double *weights) {
    PetscInt c = m->c, rows, begin, *diagonal, *off;
    Mat fine = m->matrices[m->count - 1], p, coarse;
    Vec own, held;
    PetscCheck(m->count < LEVELS, PETSC_COMM_WORLD, PETSC_ERR_ARG_OUTOFRANGE, "too many levels");
    PetscCall(MatGetLocalSize(fine, &rows, NULL));
    PetscCall(MatGetOwnershipRange(fine, &begin, NULL));
    diagonal = calloc(rows + 1, sizeof(PetscInt)), off = calloc(rows + 1, sizeof(PetscInt));
    for (PetscInt row = 0; row < rows; row++)
        for (int e = starts[row]; e < starts[row + 1]; e++)
            (columns[e] >= c * first && columns[e] < c * (first + owned) ? diagonal : off)[row]++;
    PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, rows, c * owned, PETSC_DECIDE, PETSC_DECIDE, 0, diagonal, 0, off, &p));
    free(diagonal), free(off);
    PetscCall(MatSetBlockSize(p, c));
    for (PetscInt row = 0; row < rows; row++)
        for (int e = starts[row]; e < starts[row + 1]; e++) {
            PetscInt at = begin + row, column = columns[e];
            PetscCall(MatSetValues(p, 1, &at, 1, &column, weights + e, INSERT_VALUES));
        }
    PetscCall(MatAssemblyBegin(p, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(p, MAT_FINAL_ASSEMBLY));
    /* Where nothing is free, something must be on the diagonal: what the finer level has there. */
    PetscCall(VecDuplicate(m->free, &held));
    PetscCall(MatGetDiagonal(fine, held));
    PetscCall(MatCreateVecs(p, &own, NULL));
    PetscCall(inject(&held, own, c, owned, copies));
    PetscCall(VecDuplicate(own, &own));
    Vec all = m->free;
    PetscCall(PetscObjectReference((PetscObject)all));
    PetscCall(inject(&m->free, own, c, owned, copies));
    PetscCall(MatDiagonalScale(p, all, m->free));
    PetscCall(VecDestroy(&all));
    PetscCall(MatPtAP(fine, p, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &coarse));
    PetscCall(MatSetBlockSize(coarse, c));
    PetscCall(VecDuplicate(held, &own));
    PetscCall(VecPointwiseMult(own, held, m->free));
    PetscCall(VecAXPY(held, -1.0, own));
    PetscCall(VecDestroy(&own));
    PetscCall(MatDiagonalSet(coarse, held, ADD_VALUES));
    PetscCall(VecDestroy(&held));
    PetscCall(MatSetOption(coarse, MAT_SPD, PETSC_TRUE));
    if (m->points) {
        PetscCall(VecDuplicate(m->free, &own));
        PetscCall(inject(&m->points, own, c, owned, copies));
    }
    PetscCall(VecDuplicate(m->free, &m->stiff[m->count]));
    PetscCall(MatMultTranspose(p, m->stiff[m->count - 1], m->stiff[m->count]));
    if (c > 1) {
        PetscCall(by_blocks(fine, c, &m->matrices[m->count - 1]));
        PetscCall(MatDestroy(&fine));
    }
    m->interpolations[m->count - 1] = p;
    m->matrices[m->count++] = coarse;
    return 0;
}
/* The matrix of a level with larger diagonals, for sweeps that see nothing of other processes, where one needs it.
   With L the sweep within the processes, D the diagonal blocks and O the entries between processes, sweeps there and back
   converge in the energy if L + L^T - A = D - O is positive, which need not hold where three processes meet. The surplus
   s of a row, half of what its entries in O exceed those of D by, makes D + 2 s - O dominated by its diagonal. Source:
   A. Baker, R. Falgout, T. Kolev, U. M. Yang, "Multigrid smoothers for ultraparallel computing", SIAM J. Sci. Comput. 33
   (2011), where it is the l1 smoother. */
static PetscErrorCode dominate(Mat a, PetscInt c, Mat *swept) {
    PetscInt size, begin, n;
    PetscMPIInt processes;
    const PetscInt *columns;
    const double *values;
    double *surplus, largest;
    Vec all;
    *swept = NULL;
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &processes));
    if (processes == 1) return 0;
    PetscCall(MatCreateVecs(a, &all, NULL));
    PetscCall(MatGetLocalSize(a, &size, NULL));
    PetscCall(MatGetOwnershipRange(a, &begin, NULL));
    PetscCall(VecGetArray(all, &surplus));
    for (PetscInt i = 0; i < size; i++) {
        double own = 0.0, others = 0.0;
        PetscCall(MatGetRow(a, begin + i, &n, &columns, &values));
        for (PetscInt e = 0; e < n; e++) {
            if (columns[e] < begin || columns[e] >= begin + size)
                others += PetscAbsReal(values[e]);
            else if (columns[e] == begin + i)
                own += values[e];
            else if ((columns[e] - begin) / c == i / c)
                own -= PetscAbsReal(values[e]);
        }
        PetscCall(MatRestoreRow(a, begin + i, &n, &columns, &values));
        surplus[i] = others > 0.0 ? PetscMax(0.0, 0.5 * (others - own)) : 0.0;
    }
    PetscCall(VecRestoreArray(all, &surplus));
    PetscCall(VecMax(all, NULL, &largest));
    if (largest > 0.0) {
        /* A duplicate by blocks has no sweeps: seen in PETSc 3.18.5. */
        if (c > 1)
            PetscCall(by_blocks(a, c, swept));
        else
            PetscCall(MatDuplicate(a, MAT_COPY_VALUES, swept));
        PetscCall(MatDiagonalSet(*swept, all, ADD_VALUES));
    }
    PetscCall(VecDestroy(&all));
    return 0;
}
/* One sweep: of the matrix itself, which corrects as it goes, or of another one. */
static PetscErrorCode smooth(KSP ksp, Mat matrix, Mat swept, MatSORType type) {
    PC pc;
    PetscCall(KSPSetOperators(ksp, matrix, swept ? swept : matrix));
    PetscCall(KSPSetType(ksp, KSPRICHARDSON));
    PetscCall(KSPSetTolerances(ksp, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, 1));
    PetscCall(KSPGetPC(ksp, &pc));
    if (swept) {
        KSP *own;
        PetscInt count;
        PetscCall(PCSetType(pc, PCBJACOBI));
        PetscCall(KSPSetUp(ksp));
        PetscCall(PCBJacobiGetSubKSP(pc, &count, NULL, &own));
        PetscCall(KSPSetType(own[0], KSPPREONLY));
        PetscCall(KSPGetPC(own[0], &pc));
    }
    PetscCall(PCSetType(pc, PCSOR));
    PetscCall(PCSORSetSymmetric(pc, type));
    return 0;
}
/* Remembers the rows of a level that may become stiff. */
static PetscErrorCode remember(Multigrid *m, PetscInt level) {
    PetscInt size, begin, count = 0;
    const double *marks, *entries, *swept;
    Vec diagonal, larger;
    PetscCall(VecDuplicate(m->stiff[level], &diagonal));
    PetscCall(VecDuplicate(m->stiff[level], &larger));
    PetscCall(MatGetDiagonal(m->matrices[level], diagonal));
    PetscCall(MatGetDiagonal(m->swept[level] ? m->swept[level] : m->matrices[level], larger));
    PetscCall(VecGetLocalSize(diagonal, &size));
    PetscCall(VecGetOwnershipRange(diagonal, &begin, NULL));
    PetscCall(VecGetArrayRead(m->stiff[level], &marks));
    PetscCall(VecGetArrayRead(diagonal, &entries));
    PetscCall(VecGetArrayRead(larger, &swept));
    for (PetscInt i = 0; i < size; i++) count += marks[i] != 0.0;
    m->rows[level] = malloc(sizeof(PetscInt) * (count + 1));
    m->diagonals[level] = malloc(sizeof(double) * (count + 1));
    m->surpluses[level] = malloc(sizeof(double) * (count + 1));
    for (PetscInt i = 0; i < size; i++)
        if (marks[i] != 0.0) {
            m->rows[level][m->row_counts[level]] = begin + i;
            m->surpluses[level][m->row_counts[level]] = swept[i] - entries[i];
            m->diagonals[level][m->row_counts[level]++] = entries[i];
        }
    PetscCall(VecRestoreArrayRead(larger, &swept));
    PetscCall(VecRestoreArrayRead(diagonal, &entries));
    PetscCall(VecDestroy(&larger));
    PetscCall(VecRestoreArrayRead(m->stiff[level], &marks));
    PetscCall(VecDestroy(&diagonal));
    PetscCall(MatSetOption(m->matrices[level], MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
    PetscCall(MatSetOption(m->matrices[level], MAT_NEW_NONZERO_LOCATIONS, PETSC_FALSE));
    return 0;
}
/* Adds stiffnesses to the diagonals of the components of frictional vertices, and below them to those of the vertices
   from which they are interpolated, lumped: no level is softer than the one above it. */
int ss_multigrid_stiffen(Multigrid *m, const double *stiffness) {
    PetscCall(stiffen_finest(m, stiffness));
    for (PetscInt l = 0; l < m->count; l++) {
        const double *added;
        PetscInt begin;
        if (l) PetscCall(MatMultTranspose(m->interpolations[l - 1], m->stiff[l - 1], m->stiff[l]));
        PetscCall(VecGetOwnershipRange(m->stiff[l], &begin, NULL));
        PetscCall(VecGetArrayRead(m->stiff[l], &added));
        for (PetscInt n = 0; n < m->row_counts[l]; n++) {
            PetscInt row = m->rows[l][n];
            double value = m->diagonals[l][n] + added[row - begin];
            PetscCall(MatSetValues(m->matrices[l], 1, &row, 1, &row, &value, INSERT_VALUES));
            if (!m->swept[l]) continue;
            value += m->surpluses[l][n];
            PetscCall(MatSetValues(m->swept[l], 1, &row, 1, &row, &value, INSERT_VALUES));
        }
        PetscCall(VecRestoreArrayRead(m->stiff[l], &added));
        PetscCall(MatAssemblyBegin(m->matrices[l], MAT_FINAL_ASSEMBLY));
        PetscCall(MatAssemblyEnd(m->matrices[l], MAT_FINAL_ASSEMBLY));
        if (!m->swept[l]) continue;
        PetscCall(MatAssemblyBegin(m->swept[l], MAT_FINAL_ASSEMBLY));
        PetscCall(MatAssemblyEnd(m->swept[l], MAT_FINAL_ASSEMBLY));
    }
    Mat coarse = m->matrices[m->count - 1];
    PetscCall(KSPSetOperators(m->bottom, coarse, coarse));
    return 0;
}
/* Sets up a V-cycle with a sweep before and the reverse one after each coarse correction. */
int ss_multigrid_finish(Multigrid *m) {
    Mat coarse = m->matrices[m->count - 1];
    KSP ksp;
    PetscInt size;
    PetscCall(PCCreate(PETSC_COMM_WORLD, &m->pc));
    PetscCall(PCSetOperators(m->pc, m->matrices[0], m->matrices[0]));
    PetscCall(PCSetOptionsPrefix(m->pc, "tnnmg_"));
    PetscCall(PCSetType(m->pc, PCMG));
    PetscCall(PCMGSetLevels(m->pc, m->count, NULL));
    PetscCall(PCMGSetDistinctSmoothUp(m->pc));
    for (PetscInt l = 0; l + 1 < m->count; l++) {
        PetscInt level = m->count - 1 - l;
        PetscCall(PCMGSetInterpolation(m->pc, level, m->interpolations[l]));
        PetscCall(dominate(m->matrices[l], m->c, &m->swept[l]));
        PetscCall(PCMGGetSmootherDown(m->pc, level, &ksp));
        PetscCall(smooth(ksp, m->matrices[l], m->swept[l], SOR_LOCAL_FORWARD_SWEEP));
        PetscCall(PCMGGetSmootherUp(m->pc, level, &ksp));
        PetscCall(smooth(ksp, m->matrices[l], m->swept[l], SOR_LOCAL_BACKWARD_SWEEP));
    }
    PetscCall(PCMGGetCoarseSolve(m->pc, &m->bottom));
    PetscCall(KSPSetOperators(m->bottom, coarse, coarse));
    for (PetscInt l = 0; l < m->count; l++) PetscCall(remember(m, l));
    PetscCall(MatGetSize(coarse, &size, NULL));
    if (size > FEW) {
        PC bottom;
        PetscCall(KSPGetPC(m->bottom, &bottom));
        PetscCall(PCSetType(bottom, PCGAMG));
        PetscCall(PCGAMGSetReuseInterpolation(bottom, PETSC_TRUE));
    }
    if (m->points) {
        MatNullSpace rigid;
        PetscCall(MatNullSpaceCreateRigidBody(m->points, &rigid));
        PetscCall(MatSetNearNullSpace(coarse, rigid));
        PetscCall(MatNullSpaceDestroy(&rigid));
    }
    PetscCall(VecDestroy(&m->points));
    PetscCall(VecDestroy(&m->free));
    PetscCall(PCSetFromOptions(m->pc));
    PetscCall(PCSetUp(m->pc));
    return 0;
}
/* One cycle from zero, or a product with the matrix of the finest level. */
int ss_multigrid_apply(Multigrid *m, int product, const double *in, double *out) {
    PetscCall(VecPlaceArray(m->in, in));
    PetscCall(VecPlaceArray(m->out, out));
    if (product)
        PetscCall(MatMult(m->matrices[0], m->in, m->out));
    else
        PetscCall(PCApply(m->pc, m->in, m->out));
    PetscCall(VecResetArray(m->out));
    PetscCall(VecResetArray(m->in));
    return 0;
}
