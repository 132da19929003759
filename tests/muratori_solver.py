#!/usr/bin/env python3
"""Boolean GJK in 3D after Casey Muratori, "Implementing GJK" (2006), as a student would write it: cross products for directions, the faces of
the tetrahedron tried in order. Not always the nearest region, and right all the same: gjkdbg must have nothing to say against it."""
import json,sys
def say(**m): print(json.dumps(m),flush=True)
def support(d):
    say(type="support",direction=d); r=json.loads(sys.stdin.readline()); return r["w"],r["vertex"]
dot=lambda a,b:sum(x*y for x,y in zip(a,b)); sub=lambda a,b:[x-y for x,y in zip(a,b)]; neg=lambda a:[-x for x in a]
def cross(a,b): return [a[1]*b[2]-a[2]*b[1],a[2]*b[0]-a[0]*b[2],a[0]*b[1]-a[1]*b[0]]
def triple(a,b,c): return cross(cross(a,b),c)
def line(s):
    a,b=s[0][0],s[1][0]; ab=sub(b,a); ao=neg(a)
    if dot(ab,ao)>0: return s[:2],triple(ab,ao,ab)
    return s[:1],ao
def triangle(s):
    a,b,c=[x[0] for x in s[:3]]; ab=sub(b,a); ac=sub(c,a); ao=neg(a); n=cross(ab,ac)
    if dot(cross(n,ac),ao)>0:
        if dot(ac,ao)>0: return [s[0],s[2]],triple(ac,ao,ac)
        return line([s[0],s[1]])
    if dot(cross(ab,n),ao)>0: return line([s[0],s[1]])
    if dot(n,ao)>0: return s[:3],n
    return [s[0],s[2],s[1]],neg(n)
def tetra(s):
    a=s[0][0]; ao=neg(a)
    for i,j in((1,2),(2,3),(3,1)):
        n=cross(sub(s[i][0],a),sub(s[j][0],a)); k=6-i-j
        if dot(n,sub(s[k][0],a))>0: n=neg(n)
        if dot(n,ao)>0: return triangle([s[0],s[i],s[j]]),False
    return (s,None),True
def solve():
    w=support([1,0,0]); s=[w]; d=neg(w[0])
    if not any(d): return True
    for _ in range(64):
        w=support(d)
        if dot(w[0],d)<0: return False
        s=[w]+s
        if len(s)==2: s,d=line(s)
        elif len(s)==3: s,d=triangle(s)
        else:
            (s,d2),hit=tetra(s)
            if hit:
                say(type="simplex",vertices=[x[1] for x in s]); return True
            d=d2
        if not any(abs(x)>1e-12 for x in d): say(type="simplex",vertices=[x[1] for x in s]); return True
        say(type="simplex",vertices=[x[1] for x in s],direction=d)
    return True
sc=json.loads(sys.stdin.readline())
say(type="result",intersecting=solve())
