#include "kea_factor_i.h"
#include "MeMemory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
struct KeaFactor { int n,N,m; int *size,*off; int (*edges)[2]; double *diag[20000]; double *up[60000],*lo[60000]; double *A; int lu; };
KeaFactor *kea_factorCreate(int n,const int size[],int m,const int (*e)[2]){ KeaFactor*f=calloc(1,sizeof*f); f->n=n;f->m=m;f->size=malloc(sizeof(int)*(n+1));f->off=malloc(sizeof(int)*(n+1));f->edges=malloc(sizeof(int)*2*(m+1)); int o=0; for(int i=0;i<n;i++){f->size[i]=size[i];f->off[i]=o;o+=size[i];f->diag[i]=calloc(size[i]*size[i],8);} f->off[n]=o;f->N=o; memcpy(f->edges,e,sizeof(int)*2*m); for(int i=0;i<m;i++){int s=size[e[i][0]]*size[e[i][1]];f->up[i]=calloc(s,8);f->lo[i]=calloc(s,8);} f->A=calloc((size_t)o*o,8); return f;}
void kea_factorDestroy(KeaFactor*f){ for(int i=0;i<f->n;i++)free(f->diag[i]); for(int i=0;i<f->m;i++){free(f->up[i]);free(f->lo[i]);} free(f->A);free(f->size);free(f->off);free(f->edges);free(f);}
MeBool kea_factorMatches(const KeaFactor*f,int n,const int*size,int m,const int(*e)[2]){ return f->n==n&&f->m==m&&!memcmp(f->size,size,4*n)&&!memcmp(f->edges,e,8*m);}
void kea_factorClear(KeaFactor*f){for(int i=0;i<f->n;i++)memset(f->diag[i],0,8*f->size[i]*f->size[i]);for(int i=0;i<f->m;i++){int s=f->size[f->edges[i][0]]*f->size[f->edges[i][1]];memset(f->up[i],0,8*s);memset(f->lo[i],0,8*s);}}
double*kea_factorDiagonal(KeaFactor*f,int i){return f->diag[i];} double*kea_factorUpper(KeaFactor*f,int i){return f->up[i];} double*kea_factorLower(KeaFactor*f,int i){return f->lo[i];}
int kea_factorOffset(const KeaFactor*f,int i){return f->off[i];}
static void load(KeaFactor*f,int lu){int N=f->N;memset(f->A,0,(size_t)N*N*8);for(int k=0;k<f->n;k++){int s=f->size[k],o=f->off[k];for(int i=0;i<s;i++)for(int j=0;j<s;j++)f->A[(o+i)*N+o+j]=f->diag[k][i*s+j];}for(int e=0;e<f->m;e++){int a=f->edges[e][0],b=f->edges[e][1],sa=f->size[a],sb=f->size[b];for(int i=0;i<sa;i++)for(int j=0;j<sb;j++){f->A[(f->off[a]+i)*N+f->off[b]+j]=f->up[e][i*sb+j];f->A[(f->off[b]+j)*N+f->off[a]+i]=lu?f->lo[e][j*sa+i]:f->up[e][i*sb+j];}}}
MeBool kea_factorCholesky(KeaFactor*f,double least){load(f,0);f->lu=0;int N=f->N;double*A=f->A;for(int j=0;j<N;j++){double d0=A[j*N+j],d=d0;for(int k=0;k<j;k++)d-=A[j*N+k]*A[j*N+k];if(!(d>least*d0))return 0;d=sqrt(d);A[j*N+j]=d;for(int i=j+1;i<N;i++){double s=A[i*N+j];for(int k=0;k<j;k++)s-=A[i*N+k]*A[j*N+k];A[i*N+j]=s/d;}}return 1;}
MeBool kea_factorLU(KeaFactor*f,double least){load(f,1);f->lu=1;int N=f->N;double*A=f->A;for(int k=0;k<N;k++){if(!(fabs(A[k*N+k])>0))return 0;for(int i=k+1;i<N;i++){double l=A[i*N+k]/=A[k*N+k];if(l!=0)for(int j=k+1;j<N;j++)A[i*N+j]-=l*A[k*N+j];}}(void)least;return 1;}
void kea_factorSolve(const KeaFactor*f,double*x){int N=f->N;double*A=f->A;if(f->lu){for(int i=0;i<N;i++)for(int k=0;k<i;k++)x[i]-=A[i*N+k]*x[k];for(int i=N-1;i>=0;i--){for(int k=i+1;k<N;k++)x[i]-=A[i*N+k]*x[k];x[i]/=A[i*N+i];}}else{for(int i=0;i<N;i++){for(int k=0;k<i;k++)x[i]-=A[i*N+k]*x[k];x[i]/=A[i*N+i];}for(int i=N-1;i>=0;i--){for(int k=i+1;k<N;k++)x[i]-=A[k*N+i]*x[k];x[i]/=A[i*N+i];}}}
double kea_factorFlops(const KeaFactor*f){(void)f;return 0;} size_t kea_factorEntries(const KeaFactor*f){(void)f;return 0;}
