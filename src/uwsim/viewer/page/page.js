/*! uPlot 1.6.32:
The MIT License (MIT)

Copyright (c) 2022 Leon Sorokin

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.*/
"use strict";(()=>{var yo="uwsim.reloads";var Rh="The browser's graphics process has ended. The page begins again.",Lh="The browser's graphics process ends again and again. Reload the page to try once more.";function bo(s,e){let t=!1,r=()=>{t||location.reload(),t=!0};s.addEventListener("webglcontextlost",i=>{if(i.preventDefault(),!Ph(Date.now()))return e(Lh);e(Rh),s.addEventListener("webglcontextrestored",r),setTimeout(r,3e3)})}function Ph(s){let t=(sessionStorage.getItem(yo)??"").split(" ").map(Number).filter(r=>r>s-6e4);return t.length>=3?!1:(sessionStorage.setItem(yo,[...t,s].join(" ")),!0)}function we(s){return Float64Array.from(s)}function Ie(s,e){let t=new Float64Array(16);for(let r=0;r<16;r+=4)for(let i=0;i<4;++i)t[r+i]=s[r]*e[i]+s[r+1]*e[4+i]+s[r+2]*e[8+i]+s[r+3]*e[12+i];return t}function nt(s,e=0){let[t,r,i]=[s[e],s[e+1],s[e+2]],n=Math.hypot(s[e+3],s[e+4],s[e+5],s[e+6])||1,[a,o,l,c]=[3,4,5,6].map(h=>s[e+h]/n);return we([1-2*(l*l+c*c),2*(o*l-a*c),2*(o*c+a*l),t,2*(o*l+a*c),1-2*(o*o+c*c),2*(l*c-a*o),r,2*(o*c-a*l),2*(l*c+a*o),1-2*(o*o+l*l),i,0,0,0,1])}function wo(s){let t=[[1,1,1],[1,-1,-1],[-1,1,-1],[-1,-1,1]].map(([h,f,d])=>Math.max(0,1+h*s[0]+f*s[5]+d*s[10])),[r,i,n,a]=t.map(h=>Math.sqrt(h)/2),o=t.indexOf(Math.max(...t)),l=[[1,s[9]-s[6],s[2]-s[8],s[4]-s[1]],[s[9]-s[6],1,s[1]+s[4],s[2]+s[8]],[s[2]-s[8],s[1]+s[4],1,s[6]+s[9]],[s[4]-s[1],s[2]+s[8],s[6]+s[9],1]],c=[r,i,n,a].map((h,f)=>h*(l[o][f]<0?-1:1));return[s[3],s[7],s[11],...c]}function Ze(s){let e=t=>-(s[t]*s[3]+s[4+t]*s[7]+s[8+t]*s[11]);return we([s[0],s[4],s[8],e(0),s[1],s[5],s[9],e(1),s[2],s[6],s[10],e(2),0,0,0,1])}function Pn(s){return le([s[0],s[1],s[2]],it([s[4],s[5],s[6]],[s[8],s[9],s[10]]))}function xo(s){let e=[0,4,8].map(a=>[s[a],s[a+1],s[a+2]]),t=1/Pn(s),[r,i,n]=[it(e[1],e[2]),it(e[2],e[0]),it(e[0],e[1])];return we([...[r,i,n].flatMap(a=>[a[0]*t,a[1]*t,a[2]*t,0]),0,0,0,1])}function Re(s,e){return[s[0]*e[0]+s[1]*e[1]+s[2]*e[2]+s[3],s[4]*e[0]+s[5]*e[1]+s[6]*e[2]+s[7],s[8]*e[0]+s[9]*e[1]+s[10]*e[2]+s[11]]}function Xr(s,e){return[le([s[0],s[1],s[2]],e),le([s[4],s[5],s[6]],e),le([s[8],s[9],s[10]],e)]}function $s(s,e){return[le([s[0],s[4],s[8]],e),le([s[1],s[5],s[9]],e),le([s[2],s[6],s[10]],e)]}function me(s){return[s[3],s[7],s[11]]}function le(s,e){return s[0]*e[0]+s[1]*e[1]+s[2]*e[2]}function it(s,e){return[s[1]*e[2]-s[2]*e[1],s[2]*e[0]-s[0]*e[2],s[0]*e[1]-s[1]*e[0]]}function Me(s,e,t=1){return[s[0]+t*e[0],s[1]+t*e[1],s[2]+t*e[2]]}function xt(s){let e=Math.hypot(s[0],s[1],s[2])||1;return[s[0]/e,s[1]/e,s[2]/e]}function In(s,e,t=[0,0,1]){let r=xt(Me(s,e,-1)),i=it(t,r);Math.hypot(...i)<1e-6&&(i=it([1,0,0],r)),i=xt(i);let n=it(r,i);return we([i[0],n[0],r[0],s[0],i[1],n[1],r[1],s[1],i[2],n[2],r[2],s[2],0,0,0,1])}function Eo(s,e,t){let r=Math.min(e,.75*s)/(2*Math.tan(t/2)),i={cx:(s-1)/2,cy:(e-1)/2};return{width:s,height:e,fx:r,fy:r,...i,skew:0,near:.05,far:2e3}}function bs(s,e){let[t,r]=[Math.round(s.width*e),Math.round(s.height*e)];return{...s,width:t,height:r,fx:s.fx*e,fy:s.fy*e,cx:(s.cx+.5)*e-.5,cy:(s.cy+.5)*e-.5,skew:s.skew*e}}function qt(s,e){let{width:t,height:r,near:i,far:n}=s,a=n-i,o=e?1:-1;return we([2*s.fx/t,2*s.skew/t,1-(2*s.cx+1)/t,0,0,-2*o*s.fy/r,o*(1-(2*s.cy+1)/r),0,0,0,-(n+i)/a,-2*n*i/a,0,0,-1,0])}function ht(s){return[0,1,2,3].flatMap(e=>[s[e],s[4+e],s[8+e],s[12+e]])}function Ao(s,e,t){let{width:r,height:i,cx:n,cy:a}=s;return{...s,width:r+2*e,height:i+2*t,cx:n+e,cy:a+t}}function So(s){let e=s;return we([e[0],e[4],e[8],0,e[1],e[5],e[9],0,e[2],e[6],e[10],0,0,0,0,1])}var[jr,sr,Mo,To,$r,Kr,Qr]=[3,4,5,8,9,10,11],Ih=96,Ro=2,kh=.25,Fh=1e-5,Ch=.001;function kn(s,{time:e,puffs:t},r,i){let n=r-e;if(n<=0)return t;let a=Math.exp(-n/Ro);return t.map(o=>{let l=o.slice(),c=0;for(let p=0;p<3;++p){let _=o[Mo+p]*Ro*(1-a);c+=_*_,l[p]+=_+i[p]*n,l[Mo+p]*=a}l[2]=Math.max(l[2]-s.settling_speed*n,l[To]),l[jr]=(Math.sqrt(o[jr])+kh*Math.sqrt(c))**2+2*s.diffusivity*n;let[h,f]=[Math.sqrt(l[jr]),l[2]-l[To]],d=s.settling_speed*Math.sqrt(2/Math.PI)/h;return l[sr]*=Math.exp(-n*d*Math.exp(-.5*(f/h)**2)),l})}var Ks=class{constructor(e,t,r){this.spec=e;this.births=t;this.waterAt=r}spec;births;waterAt;state={time:0,puffs:[]};nextBirth=0;puffsAt(e){e<this.state.time&&([this.state,this.nextBirth]=[{time:0,puffs:[]},0]);let{births:t,spec:r}=this;for(;;){let i=t[this.nextBirth]?.time??1/0,a=!this.state.puffs.length||i<this.state.time+r.period+Ch?i:this.state.time+r.period;if(a>e)return this.state;let o=kn(r,this.state,a,this.waterAt(a));for(this.state={time:a,puffs:o.filter(l=>l[sr]>=Fh)};t[this.nextBirth]?.time<=a;++this.nextBirth)this.add(t[this.nextBirth])}}add({puff:e}){let{puffs:t}=this.state;e?(t.length===Ih&&t.splice(0,2,Oh(t[0],t[1])),t.push(e)):t.length=0}};function Oh(s,e){let t=s[sr]+e[sr],r=e[sr]/t,i=s.map((a,o)=>(1-r)*a+r*e[o]),n=[0,1,2].reduce((a,o)=>a+(e[o]-s[o])**2,0);return i[jr]+=r*(1-r)*n/3,[i[sr],i[$r],i[Kr]]=[t,s[$r],e[Kr]],i}var Fn=class{constructor(e,t){this.head=e;this.data=t}head;data;numbers(e){let[t,r,i]=e;switch(i){case"f4":return new Float32Array(this.data,t,r);case"u4":return new Uint32Array(this.data,t,r);case"u2":return new Uint16Array(this.data,t,r);case"i2":return new Int16Array(this.data,t,r);case"i1":return new Int8Array(this.data,t,r);default:return new Uint8Array(this.data,t,r)}}};async function Po(s){let e=new Blob([s]).stream().pipeThrough(new DecompressionStream("gzip"));return new Response(e).arrayBuffer()}var Lo="0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%/()*+-;,=.?@^_`{|}~";function Io(s){let e=new Uint8Array(128);for(let i=0;i<Lo.length;++i)e[Lo.charCodeAt(i)]=i;let t=Math.ceil(s.length/5),r=new DataView(new ArrayBuffer(4*t));for(let i=0;i<t;++i){let n=0;for(let a=5*i;a<5*i+5;++a)n=85*n+(a<s.length?e[s.charCodeAt(a)]:84);r.setUint32(4*i,n)}return new Uint8Array(r.buffer,0,s.length-t)}async function ws(s){let e=await Po(s),t=new DataView(e).getUint32(0,!0),r=JSON.parse(new TextDecoder().decode(new Uint8Array(e,4,t)));return new Fn(r,e.slice(4+t))}var Cn=class{constructor(e,t,r=[],i=[]){this.head=e;this.rows=t;this.removals=r;this.births=i}head;rows;removals;births;get columns(){return 7*this.head.bodies.length+this.head.signals.length}get end(){return this.head.start+Math.max(0,this.head.n-1)/this.head.rate}rowIndex(e){return Math.floor(this.rowPosition(e)+1e-6)}rowPosition(e){return Math.min(Math.max((e-this.head.start)*this.head.rate,0),this.head.n-1)}row(e){let t=this.columns,r=this.rowIndex(e),i=this.rows.slice(r*t,(r+1)*t),n=this.rowPosition(e)-r;if(n<1e-6||r+1>=this.head.n)return i;let a=(r+1)*t;for(let o=0;o<7*this.head.bodies.length;++o)i[o]+=n*(this.rows[a+o]-i[o]);return i}};async function ko(s){let e=new Uint8Array(await Po(s)),t=e.indexOf(10),r=JSON.parse(new TextDecoder().decode(e.subarray(0,t))),i=r.n,n=7*r.bodies.length+r.signals.length,a=e.subarray(t+1),o=On(a,i,n,c=>{let h=c%7<3?r.length:r.quaternion;return c<7*r.bodies.length?h:r.signals[c-7*r.bodies.length].step}),l=Nh(r,a.subarray(4*i*n));return new Cn(r,o,l,Dh(r,a.subarray(4*(i*n+5*l.length))))}function On(s,e,t,r){let i=new Float64Array(e*t);for(let n=0;n<t;++n){let a=r(n),o=0;for(let l=0,c=n*e;l<e;++l,++c){let h=s[c]|s[e*t+c]<<8|s[2*e*t+c]<<16;o=o+(h|s[3*e*t+c]<<24)|0,i[l*t+n]=o===-2147483648?NaN:o*a}}return i}function Nh({sand:s},e){if(!s)return[];let t=On(e,s.n,5,r=>r<2?1:s.grain);return Array.from({length:s.n},(r,i)=>{let[n,a,o,l,c]=t.subarray(5*i,5*i+5);return{row:n,heap:a,position:Number.isNaN(o)?null:[o,l,c]}})}function Dh({sediment:s},e){if(!s)return[];let{n:t,steps:r}=s,i=On(e,t,r.length,n=>r[n]);return Array.from({length:t},(n,a)=>{let[o,l,c,h,f,d,p,_,y,w,E]=i.subarray(r.length*a);if(Number.isNaN(p))return{time:o,puff:null};let x=new Array(Qr);return[c,h,f,d*d,p,_,y,w,E].forEach((M,S)=>x[S]=M),[x[$r],x[Kr]]=[o,l],{time:o,puff:x}})}function z(s){let e=document.getElementById(s);if(!e)throw new Error(`the page has no element ${s}`);return e}function $(s,e="",t=""){let r=document.createElement(s);return r.textContent=e,r.className=t,r}function Nn(s){return s==="ok"?"ok":s==="lost"||s.includes("error")?"bad":"other"}function yr(s,e){let t=-1;return s.levels.forEach(({trial:r,level:i},n)=>{r===s.trial&&i.start<=e+1e-6&&(t=n)}),t}function Fo(s){let e=s.levels.filter(({trial:t})=>t===s.trial);return e.length>0&&e.every(({level:t})=>t.status==="no motion")}var Qs=class{constructor(e,t){this.player=e;this.choose=t}player;choose;list=z("levels");current=-2;lastLevel=null;show(e){this.lastLevel!==this.player.levels.at(-1)?.level&&this.fill();let t=yr(this.player,e);if(t===this.current)return;this.current=t,this.list.querySelectorAll("button").forEach((n,a)=>{if(n.setAttribute("aria-current",String(a===t)),a!==t||this.list.contains(document.activeElement))return;let o=n.offsetTop-this.list.offsetTop;(o<this.list.scrollTop||o>this.list.scrollTop+this.list.clientHeight-24)&&(this.list.scrollTop=o-this.list.clientHeight/2)});let r=this.player.levels[t]?.level,i=z("now");i.textContent=r?`${r.label} · ${r.status}`:"",i.className=`badge ${r?Nn(r.status):""}`,z("why").textContent=r?.why??"",z("why").title=r?.why??""}mark(e,t){let r=z("marks");r.replaceChildren();let i=n=>`${100*(n-e)/Math.max(t-e,1e-9)}%`;for(let{trial:n,level:a}of this.player.levels){if(n!==this.player.trial)continue;let o=$("i","",Nn(a.status));o.style.left=i(a.start),o.style.width=i(e+a.end-a.start),o.title=`${a.label}: ${a.status}`,r.append(o)}}fill(){this.lastLevel=this.player.levels.at(-1)?.level,this.current=-2,z("levels-box").hidden=!this.lastLevel,this.list.replaceChildren(...this.player.levels.map(({level:e},t)=>{let r=$("button");r.append($("span",e.label),$("span",e.status,Nn(e.status))),r.title=e.why??"",r.addEventListener("click",()=>this.choose(t));let i=$("li");return i.append(r),i}))}},Js=class{bars=[];constructor(e){let t=z("thrusters");for(let r of e.vehicles)for(let i of r.thrusters){let n=$("div"),[a,o,l]=[$("span","","bar"),$("i"),$("output")];a.append(o);let c=e.vehicles.length>1?`${r.name} ${i}`:i;n.append($("span",c.replaceAll("_"," ")),a,l),t.append(n),this.bars.push({signal:`thrust/${r.name}/${i}`,bar:o,value:l})}}show(e){let t=!1;for(let{signal:r,bar:i,value:n}of this.bars){let a=e.signal(r);if(a===void 0)continue;t=!0;let o=50*Math.min(1,Math.abs(a));i.style.left=`${a<0?50-o:50}%`,i.style.width=`${o}%`,n.textContent=`${Math.round(100*a)||0} %`}z("thrusters-box").hidden=!t}};function Co(s){let e=z("help");e.replaceChildren();let[t,r]=[$("div","","rows"),$("div","","columns")];t.tabIndex=0,t.append(r),e.append(t);for(let[n,a]of Object.entries(s)){let o=$("dl");for(let c of a)o.append($("dt",c.keys),$("dd",c.action));let l=$("section");l.append($("h2",n),o),r.append(l)}let i=$("button","Close");i.addEventListener("click",()=>e.close()),e.append(i)}function Zs(){let s=z("help");s.open?s.close():s.showModal()}var Vh=100,Uh=33,Gh=["left","right"],Oo={surge:["forward","back"],sway:["right","left"],heave:["up","down"],yaw:["turn right","left"],roll:["roll right","left"],pitch:["pitch up","down"],lamps:["lamps brighter","darker"]},zh={yaw:"turn",sway:"left / right"},Bh=6e3,ei=class{constructor(e){this.send=e;document.addEventListener("keyup",t=>{this.pressedKeys.delete(t.key.toLowerCase()),this.poll()}),window.addEventListener("blur",()=>{this.pressedKeys.clear(),this.poll()}),setInterval(()=>this.poll(),Uh)}send;isOn=!1;mapping={};reason="";names={};reservedKeys=new Set;layout="";pressedKeys=new Set;sticks=[0,0,0,0];lastText="";sendTime=0;enable(e){this.isOn=e.pilot,this.mapping=e.pilot?e.mapping:{},this.reservedKeys=new Set(e.reserved),[this.names,this.reason]=[e.names,e.why];let t=JSON.stringify([e.pilot,e.sticks,e.names,e.why]);if(t===this.layout)return;this.layout=t;let i=[...Gh.map((n,a)=>this.stick(n,2*a,e.sticks.slice(2*a,2*a+2))).filter(n=>n!==null),this.reason?$("p",this.reason,"why"):this.keyHints()];z("pilot").replaceChildren(...i.filter(n=>n!==null)),z("pilot").hidden=!e.pilot}isReserved(e){return this.isOn&&this.reservedKeys.has(e)}handlePilotKey(e){let t=e.key.toLowerCase();return e.shiftKey||!this.isReserved(t)?!1:(e.preventDefault(),t in this.mapping&&(this.pressedKeys.add(t),this.poll(),this.hideKeyHints()),!0)}help(){let e=this.keyPairs();return e.length?[...e.map(({axes:r,plusKeys:i,minusKeys:n})=>({keys:`${i||"–"}  ${n||"–"}`,action:`${this.namesOf(r)} +, −`})),{keys:"Shift",action:"with a letter: the page's own key"}]:[{keys:"–",action:this.reason||"this simulation has no pilot"}]}keyPairs(){let e=new Map;for(let[t,r]of Object.entries(this.mapping)){if(!r.trim())continue;let[i,n]=No(r),a=e.get(i)??["",""];a[n]+=(a[n]&&", ")+t,e.set(i,a)}return[...e].map(([t,[r,i]])=>({axes:t,plusKeys:r,minusKeys:i}))}namesOf(e){return e.split(" ").map(t=>{let r=this.names[t.replace("-","")];return r?t.replace(/[a-z]+\d*/,r):t}).join(" ")}keyHints(){let e=this.keyPairs();if(!e.length)return null;let t=$("div","","keyline");for(let{axes:n,plusKeys:a,minusKeys:o}of e){let l=$("span"),c=Oo[n]?.join(" / ")??this.namesOf(n);for(let h of[a,o])h&&l.append($("kbd",h.toUpperCase()));l.append(` ${c}`),t.append(l)}let r=$("span");r.append($("kbd","?")," all keys");let i=$("button","×");return i.setAttribute("aria-label","Hide the line of keys"),i.addEventListener("click",()=>t.remove()),t.append(r,i),t}hideKeyHints(){let e=z("pilot").querySelector(".keyline");e&&!e.classList.contains("leaves")&&(e.classList.add("leaves"),setTimeout(()=>e.remove(),Bh))}input(){let e=navigator.getGamepads?.().find(t=>t!==null);return{keys:[...this.pressedKeys].sort(),axes:e?e.axes.map(Dn):[],buttons:e?e.buttons.map(({value:t})=>Dn(t)):[],sticks:this.sticks.map(Dn)}}poll(){if(!this.isOn)return;let e=this.input(),t=JSON.stringify(e),r=performance.now(),i=!e.keys.length&&![...e.axes,...e.buttons,...e.sticks].some(Boolean);if(t===this.lastText&&(i||r-this.sendTime<Vh))return;let n=t!==this.lastText;this.lastText=t,this.sendTime=r,this.send({type:"input",...e},n)}stick(e,t,r){if(!r.some(f=>f.trim()))return null;let[i,n]=[$("div","",`thumb ${e}`),$("div","","label")],a=["↔","↕"];r.forEach((f,d)=>{f.trim()&&n.prepend($("span",`${a[d]} ${this.stickWords(f)}`))});let[o,l]=[$("div","","stick"),$("i")];o.title=n.innerText,o.append(l),i.append(n,o);let c=(f,d)=>{let p=Math.max(1,Math.hypot(f,d));this.sticks[t]=f/p,this.sticks[t+1]=d/p,l.style.transform=`translate(${35*f/p}px, ${-35*d/p}px)`,this.poll()},h=f=>{if(!o.hasPointerCapture(f.pointerId))return;let d=o.getBoundingClientRect(),p=d.width/2;c((f.clientX-d.left-p)/p,-(f.clientY-d.top-p)/p)};o.addEventListener("pointerdown",f=>{o.setPointerCapture(f.pointerId),h(f)}),o.addEventListener("pointermove",h);for(let f of["pointerup","pointercancel"])o.addEventListener(f,()=>c(0,0));return i}stickWords(e){let[t]=No(e);return zh[t]??Oo[t]?.join(" / ")??this.namesOf(t)}};function No(s){let e=s.trim().split(/\s+/),t=e[0].startsWith("-");return[e.map(i=>(i.startsWith("-")!==t?"-":"")+i.replace(/^[+-]+/,"")).join(" "),t?1:0]}function Dn(s){return Math.round(s*1e3)/1e3}var Wh="uplot",Hh="u-hz",Yh="u-vt",qh="u-title",Xh="u-wrap",jh="u-under",$h="u-over",Kh="u-axis",xr="u-off",Qh="u-select",Jh="u-cursor-x",Zh="u-cursor-y",ed="u-cursor-pt",td="u-legend",rd="u-live",sd="u-inline",id="u-series",nd="u-marker",Do="u-label",ad="u-value",Es="width",As="height";var Vo="bottom",Jr="left",Vn="right",ta="#000",Uo=ta+"0",Un="mousemove",Go="mousedown",Gn="mouseup",zo="mouseenter",Bo="mouseleave",Wo="dblclick",od="resize",ld="scroll",Ho="change",ni="dppxchange",ra="--",ns=typeof window<"u",Yn=ns?document:null,es=ns?window:null,cd=ns?navigator:null,ce,ti;function qn(){let s=devicePixelRatio;ce!=s&&(ce=s,ti&&jn(Ho,ti,qn),ti=matchMedia(`(min-resolution: ${ce-.001}dppx) and (max-resolution: ${ce+.001}dppx)`),Er(Ho,ti,qn),es.dispatchEvent(new CustomEvent(ni)))}function dt(s,e){if(e!=null){let t=s.classList;!t.contains(e)&&t.add(e)}}function Xn(s,e){let t=s.classList;t.contains(e)&&t.remove(e)}function xe(s,e,t){s.style[e]=t+"px"}function Pt(s,e,t,r){let i=Yn.createElement(s);return e!=null&&dt(i,e),t?.insertBefore(i,r),i}function Et(s,e){return Pt("div",s,e)}var Yo=new WeakMap;function Bt(s,e,t,r,i){let n="translate("+e+"px,"+t+"px)",a=Yo.get(s);n!=a&&(s.style.transform=n,Yo.set(s,n),e<0||t<0||e>r||t>i?dt(s,xr):Xn(s,xr))}var qo=new WeakMap;function Xo(s,e,t){let r=e+t,i=qo.get(s);r!=i&&(qo.set(s,r),s.style.background=e,s.style.borderColor=t)}var jo=new WeakMap;function $o(s,e,t,r){let i=e+""+t,n=jo.get(s);i!=n&&(jo.set(s,i),s.style.height=t+"px",s.style.width=e+"px",s.style.marginLeft=r?-e/2+"px":0,s.style.marginTop=r?-t/2+"px":0)}var sa={passive:!0},fd={...sa,capture:!0};function Er(s,e,t,r){e.addEventListener(s,t,r?fd:sa)}function jn(s,e,t,r){e.removeEventListener(s,t,sa)}ns&&qn();function It(s,e,t,r){let i;t=t||0,r=r||e.length-1;let n=r<=2147483647;for(;r-t>1;)i=n?t+r>>1:mt((t+r)/2),e[i]<s?t=i:r=i;return s-e[t]<=e[r]-s?t:r}function El(s){return(t,r,i)=>{let n=-1,a=-1;for(let o=r;o<=i;o++)if(s(t[o])){n=o;break}for(let o=i;o>=r;o--)if(s(t[o])){a=o;break}return[n,a]}}var Al=s=>s!=null,Sl=s=>s!=null&&s>0,li=El(Al),ud=El(Sl);function hd(s,e,t,r=0,i=!1){let n=i?ud:li,a=i?Sl:Al;[e,t]=n(s,e,t);let o=s[e],l=s[e];if(e>-1)if(r==1)o=s[e],l=s[t];else if(r==-1)o=s[t],l=s[e];else for(let c=e;c<=t;c++){let h=s[c];a(h)&&(h<o?o=h:h>l&&(l=h))}return[o??pe,l??-pe]}function ci(s,e,t,r){let i=Jo(s),n=Jo(e);s==e&&(i==-1?(s*=t,e/=t):(s/=t,e*=t));let a=t==10?Xt:Ml,o=i==1?mt:At,l=n==1?At:mt,c=o(a(De(s))),h=l(a(De(e))),f=ts(t,c),d=ts(t,h);return t==10&&(c<0&&(f=ve(f,-c)),h<0&&(d=ve(d,-h))),r||t==2?(s=f*i,e=d*n):(s=Pl(s,f),e=fi(e,d)),[s,e]}function ia(s,e,t,r){let i=ci(s,e,t,r);return s==0&&(i[0]=0),e==0&&(i[1]=0),i}var na=.1,Ko={mode:3,pad:na},Ms={pad:0,soft:null,mode:0},dd={min:Ms,max:Ms};function ai(s,e,t,r){return ui(t)?Qo(s,e,t):(Ms.pad=t,Ms.soft=r?0:null,Ms.mode=r?3:0,Qo(s,e,dd))}function ae(s,e){return s??e}function md(s,e,t){for(e=ae(e,0),t=ae(t,s.length-1);e<=t;){if(s[e]!=null)return!0;e++}return!1}function Qo(s,e,t){let r=t.min,i=t.max,n=ae(r.pad,0),a=ae(i.pad,0),o=ae(r.hard,-pe),l=ae(i.hard,pe),c=ae(r.soft,pe),h=ae(i.soft,-pe),f=ae(r.mode,0),d=ae(i.mode,0),p=e-s,_=Xt(p),y=et(De(s),De(e)),w=Xt(y),E=De(w-_);(p<1e-24||E>10)&&(p=0,(s==0||e==0)&&(p=1e-24,f==2&&c!=pe&&(n=0),d==2&&h!=-pe&&(a=0)));let x=p||y||1e3,M=Xt(x),S=ts(10,mt(M)),k=x*(p==0?s==0?.1:1:n),P=ve(Pl(s-k,S/10),24),F=s>=c&&(f==1||f==3&&P<=c||f==2&&P>=c)?c:pe,V=et(o,P<F&&s>=F?F:kt(F,P)),B=x*(p==0?e==0?.1:1:a),O=ve(fi(e+B,S/10),24),R=e<=h&&(d==1||d==3&&O>=h||d==2&&O<=h)?h:-pe,H=kt(l,O>R&&e<=R?R:et(R,O));return V==H&&V==0&&(H=100),[V,H]}var pd=new Intl.NumberFormat(ns?cd.language:"en-US"),aa=s=>pd.format(s),pt=Math,ii=pt.PI,De=pt.abs,mt=pt.floor,Ne=pt.round,At=pt.ceil,kt=pt.min,et=pt.max,ts=pt.pow,Jo=pt.sign,Xt=pt.log10,Ml=pt.log2,vd=(s,e=1)=>pt.sinh(s)*e,zn=(s,e=1)=>pt.asinh(s/e),pe=1/0;function Zo(s){return(Xt((s^s>>31)-(s>>31))|0)+1}function $n(s,e,t){return kt(et(s,e),t)}function Tl(s){return typeof s=="function"}function se(s){return Tl(s)?s:()=>s}var gd=()=>{},Rl=s=>s,Ll=(s,e)=>e,_d=s=>null,el=s=>!0,tl=(s,e)=>s==e,yd=/\.\d*?(?=9{6,}|0{6,})/gm,Ar=s=>{if(kl(s)||nr.has(s))return s;let e=`${s}`,t=e.match(yd);if(t==null)return s;let r=t[0].length-1;if(e.indexOf("e-")!=-1){let[i,n]=e.split("e");return+`${Ar(i)}e${n}`}return ve(s,r)};function br(s,e){return Ar(ve(Ar(s/e))*e)}function fi(s,e){return Ar(At(Ar(s/e))*e)}function Pl(s,e){return Ar(mt(Ar(s/e))*e)}function ve(s,e=0){if(kl(s))return s;let t=10**e,r=s*t*(1+Number.EPSILON);return Ne(r)/t}var nr=new Map;function Il(s){return((""+s).split(".")[1]||"").length}function Rs(s,e,t,r){let i=[],n=r.map(Il);for(let a=e;a<t;a++){let o=De(a),l=ve(ts(s,a),o);for(let c=0;c<r.length;c++){let h=s==10?+`${r[c]}e${a}`:r[c]*l,f=(a>=0?0:o)+(a>=n[c]?0:n[c]),d=s==10?h:ve(h,f);i.push(d),nr.set(d,f)}}return i}var Ts={},oa=[],rs=[null,null],ir=Array.isArray,kl=Number.isInteger,bd=s=>s===void 0;function rl(s){return typeof s=="string"}function ui(s){let e=!1;if(s!=null){let t=s.constructor;e=t==null||t==Object}return e}function wd(s){return s!=null&&typeof s=="object"}var xd=Object.getPrototypeOf(Uint8Array),Fl="__proto__";function ss(s,e=ui){let t;if(ir(s)){let r=s.find(i=>i!=null);if(ir(r)||e(r)){t=Array(s.length);for(let i=0;i<s.length;i++)t[i]=ss(s[i],e)}else t=s.slice()}else if(s instanceof xd)t=s.slice();else if(e(s)){t={};for(let r in s)r!=Fl&&(t[r]=ss(s[r],e))}else t=s;return t}function Fe(s){let e=arguments;for(let t=1;t<e.length;t++){let r=e[t];for(let i in r)i!=Fl&&(ui(s[i])?Fe(s[i],ss(r[i])):s[i]=ss(r[i]))}return s}var Ed=0,Ad=1,Sd=2;function Md(s,e,t){for(let r=0,i,n=-1;r<e.length;r++){let a=e[r];if(a>n){for(i=a-1;i>=0&&s[i]==null;)s[i--]=null;for(i=a+1;i<t&&s[i]==null;)s[n=i++]=null}}}function Td(s,e){if(Pd(s)){let a=s[0].slice();for(let o=1;o<s.length;o++)a.push(...s[o].slice(1));return Id(a[0])||(a=Ld(a)),a}let t=new Set;for(let a=0;a<s.length;a++){let l=s[a][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let r=[Array.from(t).sort((a,o)=>a-o)],i=r[0].length,n=new Map;for(let a=0;a<i;a++)n.set(r[0][a],a);for(let a=0;a<s.length;a++){let o=s[a],l=o[0];for(let c=1;c<o.length;c++){let h=o[c],f=Array(i).fill(void 0),d=e?e[a][c]:Ad,p=[];for(let _=0;_<h.length;_++){let y=h[_],w=n.get(l[_]);y===null?d!=Ed&&(f[w]=y,d==Sd&&p.push(w)):f[w]=y}Md(f,p,i),r.push(f)}}return r}var Rd=typeof queueMicrotask>"u"?s=>Promise.resolve().then(s):queueMicrotask;function Ld(s){let e=s[0],t=e.length,r=Array(t);for(let n=0;n<r.length;n++)r[n]=n;r.sort((n,a)=>e[n]-e[a]);let i=[];for(let n=0;n<s.length;n++){let a=s[n],o=Array(t);for(let l=0;l<t;l++)o[l]=a[r[l]];i.push(o)}return i}function Pd(s){let e=s[0][0],t=e.length;for(let r=1;r<s.length;r++){let i=s[r][0];if(i.length!=t)return!1;if(i!=e){for(let n=0;n<t;n++)if(i[n]!=e[n])return!1}}return!0}function Id(s,e=100){let t=s.length;if(t<=1)return!0;let r=0,i=t-1;for(;r<=i&&s[r]==null;)r++;for(;i>=r&&s[i]==null;)i--;if(i<=r)return!0;let n=et(1,mt((i-r+1)/e));for(let a=s[r],o=r+n;o<=i;o+=n){let l=s[o];if(l!=null){if(l<=a)return!1;a=l}}return!0}var Cl=["January","February","March","April","May","June","July","August","September","October","November","December"],Ol=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Nl(s){return s.slice(0,3)}var kd=Ol.map(Nl),Fd=Cl.map(Nl),Cd={MMMM:Cl,MMM:Fd,WWWW:Ol,WWW:kd};function xs(s){return(s<10?"0":"")+s}function Od(s){return(s<10?"00":s<100?"0":"")+s}var Nd={YYYY:s=>s.getFullYear(),YY:s=>(s.getFullYear()+"").slice(2),MMMM:(s,e)=>e.MMMM[s.getMonth()],MMM:(s,e)=>e.MMM[s.getMonth()],MM:s=>xs(s.getMonth()+1),M:s=>s.getMonth()+1,DD:s=>xs(s.getDate()),D:s=>s.getDate(),WWWW:(s,e)=>e.WWWW[s.getDay()],WWW:(s,e)=>e.WWW[s.getDay()],HH:s=>xs(s.getHours()),H:s=>s.getHours(),h:s=>{let e=s.getHours();return e==0?12:e>12?e-12:e},AA:s=>s.getHours()>=12?"PM":"AM",aa:s=>s.getHours()>=12?"pm":"am",a:s=>s.getHours()>=12?"p":"a",mm:s=>xs(s.getMinutes()),m:s=>s.getMinutes(),ss:s=>xs(s.getSeconds()),s:s=>s.getSeconds(),fff:s=>Od(s.getMilliseconds())};function la(s,e){e=e||Cd;let t=[],r=/\{([a-z]+)\}|[^{]+/gi,i;for(;i=r.exec(s);)t.push(i[0][0]=="{"?Nd[i[1]]:i[0]);return n=>{let a="";for(let o=0;o<t.length;o++)a+=typeof t[o]=="string"?t[o]:t[o](n,e);return a}}var Dd=new Intl.DateTimeFormat().resolvedOptions().timeZone;function Vd(s,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+s+s.getTimezoneOffset()*6e4):e==Dd?t=s:(t=new Date(s.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(s.getMilliseconds())),t}var Dl=s=>s%1==0,oi=[1,2,2.5,5],Ud=Rs(10,-32,0,oi),Vl=Rs(10,0,32,oi),Gd=Vl.filter(Dl),wr=Ud.concat(Vl),ca=`
`,Ul="{YYYY}",sl=ca+Ul,Gl="{M}/{D}",Ss=ca+Gl,ri=Ss+"/{YY}",zl="{aa}",zd="{h}:{mm}",Zr=zd+zl,il=ca+Zr,nl=":{ss}",ue=null;function Bl(s){let e=s*1e3,t=e*60,r=t*60,i=r*24,n=i*30,a=i*365,l=(s==1?Rs(10,0,3,oi).filter(Dl):Rs(10,-3,0,oi)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,r,r*2,r*3,r*4,r*6,r*8,r*12,i,i*2,i*3,i*4,i*5,i*6,i*7,i*8,i*9,i*10,i*15,n,n*2,n*3,n*4,n*6,a,a*2,a*5,a*10,a*25,a*50,a*100]),c=[[a,Ul,ue,ue,ue,ue,ue,ue,1],[i*28,"{MMM}",sl,ue,ue,ue,ue,ue,1],[i,Gl,sl,ue,ue,ue,ue,ue,1],[r,"{h}"+zl,ri,ue,Ss,ue,ue,ue,1],[t,Zr,ri,ue,Ss,ue,ue,ue,1],[e,nl,ri+" "+Zr,ue,Ss+" "+Zr,ue,il,ue,1],[s,nl+".{fff}",ri+" "+Zr,ue,Ss+" "+Zr,ue,il,ue,1]];function h(f){return(d,p,_,y,w,E)=>{let x=[],M=w>=a,S=w>=n&&w<a,k=f(_),P=ve(k*s,3),F=Bn(k.getFullYear(),M?0:k.getMonth(),S||M?1:k.getDate()),V=ve(F*s,3);if(S||M){let B=S?w/n:0,O=M?w/a:0,R=P==V?P:ve(Bn(F.getFullYear()+O,F.getMonth()+B,1)*s,3),H=new Date(Ne(R/s)),U=H.getFullYear(),X=H.getMonth();for(let W=0;R<=y;W++){let Z=Bn(U+O*W,X+B*W,1),j=Z-f(ve(Z*s,3));R=ve((+Z+j)*s,3),R<=y&&x.push(R)}}else{let B=w>=i?i:w,O=mt(_)-mt(P),R=V+O+fi(P-V,B);x.push(R);let H=f(R),U=H.getHours()+H.getMinutes()/t+H.getSeconds()/r,X=w/r,W=d.axes[p]._space,Z=E/W;for(;R=ve(R+w,s==1?0:3),!(R>y);)if(X>1){let j=mt(ve(U+X,6))%24,ie=f(R).getHours()-j;ie>1&&(ie=-1),R-=ie*r,U=(U+X)%24;let he=x[x.length-1];ve((R-he)/w,3)*Z>=.7&&x.push(R)}else x.push(R)}return x}}return[l,c,h]}var[Bd,Wd,Hd]=Bl(1),[Yd,qd,Xd]=Bl(.001);Rs(2,-53,53,[1]);function al(s,e){return s.map(t=>t.map((r,i)=>i==0||i==8||r==null?r:e(i==1||t[8]==0?r:t[1]+r)))}function ol(s,e){return(t,r,i,n,a)=>{let o=e.find(_=>a>=_[0])||e[e.length-1],l,c,h,f,d,p;return r.map(_=>{let y=s(_),w=y.getFullYear(),E=y.getMonth(),x=y.getDate(),M=y.getHours(),S=y.getMinutes(),k=y.getSeconds(),P=w!=l&&o[2]||E!=c&&o[3]||x!=h&&o[4]||M!=f&&o[5]||S!=d&&o[6]||k!=p&&o[7]||o[1];return l=w,c=E,h=x,f=M,d=S,p=k,P(y)})}}function jd(s,e){let t=la(e);return(r,i,n,a,o)=>i.map(l=>t(s(l)))}function Bn(s,e,t){return new Date(s,e,t)}function ll(s,e){return e(s)}var $d="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function cl(s,e){return(t,r,i,n)=>n==null?ra:e(s(r))}function Kd(s,e){let t=s.series[e];return t.width?t.stroke(s,e):t.points.width?t.points.stroke(s,e):null}function Qd(s,e){return s.series[e].fill(s,e)}var Jd={show:!0,live:!0,isolate:!1,mount:gd,markers:{show:!0,width:2,stroke:Kd,fill:Qd,dash:"solid"},idx:null,idxs:null,values:[]};function Zd(s,e){let t=s.cursor.points,r=Et(),i=t.size(s,e);xe(r,Es,i),xe(r,As,i);let n=i/-2;xe(r,"marginLeft",n),xe(r,"marginTop",n);let a=t.width(s,e,i);return a&&xe(r,"borderWidth",a),r}function em(s,e){let t=s.series[e].points;return t._fill||t._stroke}function tm(s,e){let t=s.series[e].points;return t._stroke||t._fill}function rm(s,e){return s.series[e].points.size}var Wn=[0,0];function sm(s,e,t){return Wn[0]=e,Wn[1]=t,Wn}function si(s,e,t,r=!0){return i=>{i.button==0&&(!r||i.target==e)&&t(i)}}function Hn(s,e,t,r=!0){return i=>{(!r||i.target==e)&&t(i)}}var im={show:!0,x:!0,y:!0,lock:!1,move:sm,points:{one:!1,show:Zd,size:rm,width:0,stroke:tm,fill:em},bind:{mousedown:si,mouseup:si,click:si,dblclick:si,mousemove:Hn,mouseleave:Hn,mouseenter:Hn},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(s,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(s,e,t,r,i)=>r-i,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Wl={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},fa=Fe({},Wl,{filter:Ll}),Hl=Fe({},fa,{size:10}),Yl=Fe({},Wl,{show:!1}),ua='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',ql="bold "+ua,Xl=1.5,fl={show:!0,scale:"x",stroke:ta,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:ql,side:2,grid:fa,ticks:Hl,border:Yl,font:ua,lineGap:Xl,rotate:0},nm="Value",am="Time",ul={show:!0,scale:"x",auto:!1,sorted:1,min:pe,max:-pe,idxs:[]};function om(s,e,t,r,i){return e.map(n=>n==null?"":aa(n))}function lm(s,e,t,r,i,n,a){let o=[],l=nr.get(i)||0;t=a?t:ve(fi(t,i),l);for(let c=t;c<=r;c=ve(c+i,l))o.push(Object.is(c,-0)?0:c);return o}function Kn(s,e,t,r,i,n,a){let o=[],l=s.scales[s.axes[e].scale].log,c=l==10?Xt:Ml,h=mt(c(t));i=ts(l,h),l==10&&(i=wr[It(i,wr)]);let f=t,d=i*l;l==10&&(d=wr[It(d,wr)]);do o.push(f),f=f+i,l==10&&!nr.has(f)&&(f=ve(f,nr.get(i))),f>=d&&(i=f,d=i*l,l==10&&(d=wr[It(d,wr)]));while(f<=r);return o}function cm(s,e,t,r,i,n,a){let l=s.scales[s.axes[e].scale].asinh,c=r>l?Kn(s,e,et(l,t),r,i):[l],h=r>=0&&t<=0?[0]:[];return(t<-l?Kn(s,e,et(l,-r),-t,i):[l]).reverse().map(d=>-d).concat(h,c)}var jl=/./,fm=/[12357]/,um=/[125]/,hl=/1/,Qn=(s,e,t,r)=>s.map((i,n)=>e==4&&i==0||n%r==0&&t.test(i.toExponential()[i<0?1:0])?i:null);function hm(s,e,t,r,i){let n=s.axes[t],a=n.scale,o=s.scales[a],l=s.valToPos,c=n._space,h=l(10,a),f=l(9,a)-h>=c?jl:l(7,a)-h>=c?fm:l(5,a)-h>=c?um:hl;if(f==hl){let d=De(l(1,a)-h);if(d<c)return Qn(e.slice().reverse(),o.distr,f,At(c/d)).reverse()}return Qn(e,o.distr,f,1)}function dm(s,e,t,r,i){let n=s.axes[t],a=n.scale,o=n._space,l=s.valToPos,c=De(l(1,a)-l(2,a));return c<o?Qn(e.slice().reverse(),3,jl,At(o/c)).reverse():e}function mm(s,e,t,r){return r==null?ra:e==null?"":aa(e)}var dl={show:!0,scale:"y",stroke:ta,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:ql,side:3,grid:fa,ticks:Hl,border:Yl,font:ua,lineGap:Xl,rotate:0};function pm(s,e){let t=3+(s||1)*2;return ve(t*e,3)}function vm(s,e){let{scale:t,idxs:r}=s.series[0],i=s._data[0],n=s.valToPos(i[r[0]],t,!0),a=s.valToPos(i[r[1]],t,!0),o=De(a-n),l=s.series[e],c=o/(l.points.space*ce);return r[1]-r[0]<=c}var ml={scale:null,auto:!0,sorted:0,min:pe,max:-pe},$l=(s,e,t,r,i)=>i,pl={show:!0,auto:!0,sorted:0,gaps:$l,alpha:1,facets:[Fe({},ml,{scale:"x"}),Fe({},ml,{scale:"y"})]},vl={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:$l,alpha:1,points:{show:vm,filter:null},values:null,min:pe,max:-pe,idxs:[],path:null,clip:null};function gm(s,e,t,r,i){return t/10}var Kl={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},_m=Fe({},Kl,{time:!1,ori:1}),gl={};function Ql(s,e){let t=gl[s];return t||(t={key:s,plots:[],sub(r){t.plots.push(r)},unsub(r){t.plots=t.plots.filter(i=>i!=r)},pub(r,i,n,a,o,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=i&&t.plots[h].pub(r,i,n,a,o,l,c)}},s!=null&&(gl[s]=t)),t}var is=1,Jn=2;function Sr(s,e,t){let r=s.mode,i=s.series[e],n=r==2?s._data[e]:s._data,a=s.scales,o=s.bbox,l=n[0],c=r==2?n[1]:n[e],h=r==2?a[i.facets[0].scale]:a[s.series[0].scale],f=r==2?a[i.facets[1].scale]:a[i.scale],d=o.left,p=o.top,_=o.width,y=o.height,w=s.valToPosH,E=s.valToPosV;return h.ori==0?t(i,l,c,h,f,w,E,d,p,_,y,di,as,pi,Zl,tc):t(i,l,c,h,f,E,w,p,d,y,_,mi,os,ma,ec,rc)}function ha(s,e){let t=0,r=0,i=ae(s.bands,oa);for(let n=0;n<i.length;n++){let a=i[n];a.series[0]==e?t=a.dir:a.series[1]==e&&(a.dir==1?r|=1:r|=2)}return[t,r==1?-1:r==2?1:r==3?2:0]}function ym(s,e,t,r,i){let n=s.mode,a=s.series[e],o=n==2?a.facets[1].scale:a.scale,l=s.scales[o];return i==-1?l.min:i==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function jt(s,e,t,r,i,n){return Sr(s,e,(a,o,l,c,h,f,d,p,_,y,w)=>{let E=a.pxRound,x=c.dir*(c.ori==0?1:-1),M=c.ori==0?as:os,S,k;x==1?(S=t,k=r):(S=r,k=t);let P=E(f(o[S],c,y,p)),F=E(d(l[S],h,w,_)),V=E(f(o[k],c,y,p)),B=E(d(n==1?h.max:h.min,h,w,_)),O=new Path2D(i);return M(O,V,B),M(O,P,B),M(O,P,F),O})}function hi(s,e,t,r,i,n){let a=null;if(s.length>0){a=new Path2D;let o=e==0?pi:ma,l=t;for(let f=0;f<s.length;f++){let d=s[f];if(d[1]>d[0]){let p=d[0]-l;p>0&&o(a,l,r,p,r+n),l=d[1]}}let c=t+i-l,h=10;c>0&&o(a,l,r-h/2,c,r+n+h)}return a}function bm(s,e,t){let r=s[s.length-1];r&&r[0]==e?r[1]=t:s.push([e,t])}function da(s,e,t,r,i,n,a){let o=[],l=s.length;for(let c=i==1?t:r;c>=t&&c<=r;c+=i)if(e[c]===null){let f=c,d=c;if(i==1)for(;++c<=r&&e[c]===null;)d=c;else for(;--c>=t&&e[c]===null;)d=c;let p=n(s[f]),_=d==f?p:n(s[d]),y=f-i;p=a<=0&&y>=0&&y<l?n(s[y]):p;let E=d+i;_=a>=0&&E>=0&&E<l?n(s[E]):_,_>=p&&o.push([p,_])}return o}function _l(s){return s==0?Rl:s==1?Ne:e=>br(e,s)}function Jl(s){let e=s==0?di:mi,t=s==0?(i,n,a,o,l,c)=>{i.arcTo(n,a,o,l,c)}:(i,n,a,o,l,c)=>{i.arcTo(a,n,l,o,c)},r=s==0?(i,n,a,o,l)=>{i.rect(n,a,o,l)}:(i,n,a,o,l)=>{i.rect(a,n,l,o)};return(i,n,a,o,l,c=0,h=0)=>{c==0&&h==0?r(i,n,a,o,l):(c=kt(c,o/2,l/2),h=kt(h,o/2,l/2),e(i,n+c,a),t(i,n+o,a,n+o,a+l,c),t(i,n+o,a+l,n,a+l,h),t(i,n,a+l,n,a,h),t(i,n,a,n+o,a,c),i.closePath())}}var di=(s,e,t)=>{s.moveTo(e,t)},mi=(s,e,t)=>{s.moveTo(t,e)},as=(s,e,t)=>{s.lineTo(e,t)},os=(s,e,t)=>{s.lineTo(t,e)},pi=Jl(0),ma=Jl(1),Zl=(s,e,t,r,i,n)=>{s.arc(e,t,r,i,n)},ec=(s,e,t,r,i,n)=>{s.arc(t,e,r,i,n)},tc=(s,e,t,r,i,n,a)=>{s.bezierCurveTo(e,t,r,i,n,a)},rc=(s,e,t,r,i,n,a)=>{s.bezierCurveTo(t,e,i,r,a,n)};function sc(s){return(e,t,r,i,n)=>Sr(e,t,(a,o,l,c,h,f,d,p,_,y,w)=>{let{pxRound:E,points:x}=a,M,S;c.ori==0?(M=di,S=Zl):(M=mi,S=ec);let k=ve(x.width*ce,3),P=(x.size-x.width)/2*ce,F=ve(P*2,3),V=new Path2D,B=new Path2D,{left:O,top:R,width:H,height:U}=e.bbox;pi(B,O-F,R-F,H+F*2,U+F*2);let X=W=>{if(l[W]!=null){let Z=E(f(o[W],c,y,p)),j=E(d(l[W],h,w,_));M(V,Z+P,j),S(V,Z,j,P,0,ii*2)}};if(n)n.forEach(X);else for(let W=r;W<=i;W++)X(W);return{stroke:k>0?V:null,fill:V,clip:B,flags:is|Jn}})}function ic(s){return(e,t,r,i,n,a)=>{r!=i&&(n!=r&&a!=r&&s(e,t,r),n!=i&&a!=i&&s(e,t,i),s(e,t,a))}}var wm=ic(as),xm=ic(os);function nc(s){let e=ae(s?.alignGaps,0);return(t,r,i,n)=>Sr(t,r,(a,o,l,c,h,f,d,p,_,y,w)=>{[i,n]=li(l,i,n);let E=a.pxRound,x=U=>E(f(U,c,y,p)),M=U=>E(d(U,h,w,_)),S,k;c.ori==0?(S=as,k=wm):(S=os,k=xm);let P=c.dir*(c.ori==0?1:-1),F={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:is},V=F.stroke,B=!1;if(n-i>=y*4){let U=Y=>t.posToVal(Y,c.key,!0),X=null,W=null,Z,j,tt,Ee=x(o[P==1?i:n]),ie=x(o[i]),he=x(o[n]),te=U(P==1?ie+1:he-1);for(let Y=P==1?i:n;Y>=i&&Y<=n;Y+=P){let Ce=o[Y],Ae=(P==1?Ce<te:Ce>te)?Ee:x(Ce),fe=l[Y];Ae==Ee?fe!=null?(j=fe,X==null?(S(V,Ae,M(j)),Z=X=W=j):j<X?X=j:j>W&&(W=j)):fe===null&&(B=!0):(X!=null&&k(V,Ee,M(X),M(W),M(Z),M(j)),fe!=null?(j=fe,S(V,Ae,M(j)),X=W=Z=j):(X=W=null,fe===null&&(B=!0)),Ee=Ae,te=U(Ee+P))}X!=null&&X!=W&&tt!=Ee&&k(V,Ee,M(X),M(W),M(Z),M(j))}else for(let U=P==1?i:n;U>=i&&U<=n;U+=P){let X=l[U];X===null?B=!0:X!=null&&S(V,x(o[U]),M(X))}let[R,H]=ha(t,r);if(a.fill!=null||R!=0){let U=F.fill=new Path2D(V),X=a.fillTo(t,r,a.min,a.max,R),W=M(X),Z=x(o[i]),j=x(o[n]);P==-1&&([j,Z]=[Z,j]),S(U,j,W),S(U,Z,W)}if(!a.spanGaps){let U=[];B&&U.push(...da(o,l,i,n,P,x,e)),F.gaps=U=a.gaps(t,r,i,n,U),F.clip=hi(U,c.ori,p,_,y,w)}return H!=0&&(F.band=H==2?[jt(t,r,i,n,V,-1),jt(t,r,i,n,V,1)]:jt(t,r,i,n,V,H)),F})}function Em(s){let e=ae(s.align,1),t=ae(s.ascDesc,!1),r=ae(s.alignGaps,0),i=ae(s.extend,!1);return(n,a,o,l)=>Sr(n,a,(c,h,f,d,p,_,y,w,E,x,M)=>{[o,l]=li(f,o,l);let S=c.pxRound,{left:k,width:P}=n.bbox,F=ie=>S(_(ie,d,x,w)),V=ie=>S(y(ie,p,M,E)),B=d.ori==0?as:os,O={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:is},R=O.stroke,H=d.dir*(d.ori==0?1:-1),U=V(f[H==1?o:l]),X=F(h[H==1?o:l]),W=X,Z=X;i&&e==-1&&(Z=k,B(R,Z,U)),B(R,X,U);for(let ie=H==1?o:l;ie>=o&&ie<=l;ie+=H){let he=f[ie];if(he==null)continue;let te=F(h[ie]),Y=V(he);e==1?B(R,te,U):B(R,W,Y),B(R,te,Y),U=Y,W=te}let j=W;i&&e==1&&(j=k+P,B(R,j,U));let[tt,Ee]=ha(n,a);if(c.fill!=null||tt!=0){let ie=O.fill=new Path2D(R),he=c.fillTo(n,a,c.min,c.max,tt),te=V(he);B(ie,j,te),B(ie,Z,te)}if(!c.spanGaps){let ie=[];ie.push(...da(h,f,o,l,H,F,r));let he=c.width*ce/2,te=t||e==1?he:-he,Y=t||e==-1?-he:he;ie.forEach(Ce=>{Ce[0]+=te,Ce[1]+=Y}),O.gaps=ie=c.gaps(n,a,o,l,ie),O.clip=hi(ie,d.ori,w,E,x,M)}return Ee!=0&&(O.band=Ee==2?[jt(n,a,o,l,R,-1),jt(n,a,o,l,R,1)]:jt(n,a,o,l,R,Ee)),O})}function yl(s,e,t,r,i,n,a=pe){if(s.length>1){let o=null;for(let l=0,c=1/0;l<s.length;l++)if(e[l]!==void 0){if(o!=null){let h=De(s[l]-s[o]);h<c&&(c=h,a=De(t(s[l],r,i,n)-t(s[o],r,i,n)))}o=l}}return a}function Am(s){s=s||Ts;let e=ae(s.size,[.6,pe,1]),t=s.align||0,r=s.gap||0,i=s.radius;i=i==null?[0,0]:typeof i=="number"?[i,0]:i;let n=se(i),a=1-e[0],o=ae(e[1],pe),l=ae(e[2],1),c=ae(s.disp,Ts),h=ae(s.each,p=>{}),{fill:f,stroke:d}=c;return(p,_,y,w)=>Sr(p,_,(E,x,M,S,k,P,F,V,B,O,R)=>{let H=E.pxRound,U=t,X=r*ce,W=o*ce,Z=l*ce,j,tt;S.ori==0?[j,tt]=n(p,_):[tt,j]=n(p,_);let Ee=S.dir*(S.ori==0?1:-1),ie=S.ori==0?pi:ma,he=S.ori==0?h:(D,ge,Oe,Ir,ur,Nt,hr)=>{h(D,ge,Oe,ur,Ir,hr,Nt)},te=ae(p.bands,oa).find(D=>D.series[0]==_),Y=te!=null?te.dir:0,Ce=E.fillTo(p,_,E.min,E.max,Y),je=H(F(Ce,k,R,B)),Ae,fe,St,ot=O,Te=H(E.width*ce),Ot=!1,Wt=null,vt=null,Qt=null,Rr=null;f!=null&&(Te==0||d!=null)&&(Ot=!0,Wt=f.values(p,_,y,w),vt=new Map,new Set(Wt).forEach(D=>{D!=null&&vt.set(D,new Path2D)}),Te>0&&(Qt=d.values(p,_,y,w),Rr=new Map,new Set(Qt).forEach(D=>{D!=null&&Rr.set(D,new Path2D)})));let{x0:Lr,size:hs}=c;if(Lr!=null&&hs!=null){U=1,x=Lr.values(p,_,y,w),Lr.unit==2&&(x=x.map(Oe=>p.posToVal(V+Oe*O,S.key,!0)));let D=hs.values(p,_,y,w);hs.unit==2?fe=D[0]*O:fe=P(D[0],S,O,V)-P(0,S,O,V),ot=yl(x,M,P,S,O,V,ot),St=ot-fe+X}else ot=yl(x,M,P,S,O,V,ot),St=ot*a+X,fe=ot-St;St<1&&(St=0),Te>=fe/2&&(Te=0),St<5&&(H=Rl);let Us=St>0,cr=ot-St-(Us?Te:0);fe=H($n(cr,Z,W)),Ae=(U==0?fe/2:U==Ee?0:fe)-U*Ee*((U==0?X/2:0)+(Us?Te/2:0));let $e={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Pr=Ot?null:new Path2D,Ht=null;if(te!=null)Ht=p.data[te.series[1]];else{let{y0:D,y1:ge}=c;D!=null&&ge!=null&&(M=ge.values(p,_,y,w),Ht=D.values(p,_,y,w))}let fr=j*fe,ee=tt*fe;for(let D=Ee==1?y:w;D>=y&&D<=w;D+=Ee){let ge=M[D];if(ge==null)continue;if(Ht!=null){let rt=Ht[D]??0;if(ge-rt==0)continue;je=F(rt,k,R,B)}let Oe=S.distr!=2||c!=null?x[D]:D,Ir=P(Oe,S,O,V),ur=F(ae(ge,Ce),k,R,B),Nt=H(Ir-Ae),hr=H(et(ur,je)),lt=H(kt(ur,je)),gt=hr-lt;if(ge!=null){let rt=ge<0?ee:fr,Mt=ge<0?fr:ee;Ot?(Te>0&&Qt[D]!=null&&ie(Rr.get(Qt[D]),Nt,lt+mt(Te/2),fe,et(0,gt-Te),rt,Mt),Wt[D]!=null&&ie(vt.get(Wt[D]),Nt,lt+mt(Te/2),fe,et(0,gt-Te),rt,Mt)):ie(Pr,Nt,lt+mt(Te/2),fe,et(0,gt-Te),rt,Mt),he(p,_,D,Nt-Te/2,lt,fe+Te,gt)}}return Te>0?$e.stroke=Ot?Rr:Pr:Ot||($e._fill=E.width==0?E._fill:E._stroke??E._fill,$e.width=0),$e.fill=Ot?vt:Pr,$e})}function Sm(s,e){let t=ae(e?.alignGaps,0);return(r,i,n,a)=>Sr(r,i,(o,l,c,h,f,d,p,_,y,w,E)=>{[n,a]=li(c,n,a);let x=o.pxRound,M=j=>x(d(j,h,w,_)),S=j=>x(p(j,f,E,y)),k,P,F;h.ori==0?(k=di,F=as,P=tc):(k=mi,F=os,P=rc);let V=h.dir*(h.ori==0?1:-1),B=M(l[V==1?n:a]),O=B,R=[],H=[];for(let j=V==1?n:a;j>=n&&j<=a;j+=V)if(c[j]!=null){let Ee=l[j],ie=M(Ee);R.push(O=ie),H.push(S(c[j]))}let U={stroke:s(R,H,k,F,P,x),fill:null,clip:null,band:null,gaps:null,flags:is},X=U.stroke,[W,Z]=ha(r,i);if(o.fill!=null||W!=0){let j=U.fill=new Path2D(X),tt=o.fillTo(r,i,o.min,o.max,W),Ee=S(tt);F(j,O,Ee),F(j,B,Ee)}if(!o.spanGaps){let j=[];j.push(...da(l,c,n,a,V,M,t)),U.gaps=j=o.gaps(r,i,n,a,j),U.clip=hi(j,h.ori,_,y,w,E)}return Z!=0&&(U.band=Z==2?[jt(r,i,n,a,X,-1),jt(r,i,n,a,X,1)]:jt(r,i,n,a,X,Z)),U})}function Mm(s){return Sm(Tm,s)}function Tm(s,e,t,r,i,n){let a=s.length;if(a<2)return null;let o=new Path2D;if(t(o,s[0],e[0]),a==2)r(o,s[1],e[1]);else{let l=Array(a),c=Array(a-1),h=Array(a-1),f=Array(a-1);for(let d=0;d<a-1;d++)h[d]=e[d+1]-e[d],f[d]=s[d+1]-s[d],c[d]=h[d]/f[d];l[0]=c[0];for(let d=1;d<a-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(f[d-1]+f[d])/((2*f[d]+f[d-1])/c[d-1]+(f[d]+2*f[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[a-1]=c[a-2];for(let d=0;d<a-1;d++)i(o,s[d]+f[d]/3,e[d]+l[d]*f[d]/3,s[d+1]-f[d]/3,e[d+1]-l[d+1]*f[d]/3,s[d+1],e[d+1])}return o}var Zn=new Set;function bl(){for(let s of Zn)s.syncRect(!0)}ns&&(Er(od,es,bl),Er(ld,es,bl,!0),Er(ni,es,()=>{He.pxRatio=ce}));var Rm=nc(),Lm=sc();function wl(s,e,t,r){return(r?[s[0],s[1]].concat(s.slice(2)):[s[0]].concat(s.slice(1))).map((n,a)=>ea(n,a,e,t))}function Pm(s,e){return s.map((t,r)=>r==0?{}:Fe({},e,t))}function ea(s,e,t,r){return Fe({},e==0?t:r,s)}function ac(s,e,t){return e==null?rs:[e,t]}var Im=ac;function km(s,e,t){return e==null?rs:ai(e,t,na,!0)}function oc(s,e,t,r){return e==null?rs:ci(e,t,s.scales[r].log,!1)}var Fm=oc;function lc(s,e,t,r){return e==null?rs:ia(e,t,s.scales[r].log,!1)}var Cm=lc;function Om(s,e,t,r,i){let n=et(Zo(s),Zo(e)),a=e-s,o=It(i/r*a,t);do{let l=t[o],c=r*l/a;if(c>=i&&n+(l<5?nr.get(l):0)<=17)return[l,c]}while(++o<t.length);return[0,0]}function xl(s){let e,t;return s=s.replace(/(\d+)px/,(r,i)=>(e=Ne((t=+i)*ce))+"px"),[s,e,t]}function Nm(s){s.show&&[s.font,s.labelFont].forEach(e=>{let t=ve(e[2]*ce,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function He(s,e,t){let r={mode:ae(s.mode,1)},i=r.mode;function n(u,m,v,g){let b=m.valToPct(u);return g+v*(m.dir==-1?1-b:b)}function a(u,m,v,g){let b=m.valToPct(u);return g+v*(m.dir==-1?b:1-b)}function o(u,m,v,g){return m.ori==0?n(u,m,v,g):a(u,m,v,g)}r.valToPosH=n,r.valToPosV=a;let l=!1;r.status=0;let c=r.root=Et(Wh);if(s.id!=null&&(c.id=s.id),dt(c,s.class),s.title){let u=Et(qh,c);u.textContent=s.title}let h=Pt("canvas"),f=r.ctx=h.getContext("2d"),d=Et(Xh,c);Er("click",d,u=>{u.target===_&&(_e!=Br||Se!=Wr)&&qe.click(r,u)},!0);let p=r.under=Et(jh,d);d.appendChild(h);let _=r.over=Et($h,d);s=ss(s);let y=+ae(s.pxAlign,1),w=_l(y);(s.plugins||[]).forEach(u=>{u.opts&&(s=u.opts(r,s)||s)});let E=s.ms||.001,x=r.series=i==1?wl(s.series||[],ul,vl,!1):Pm(s.series||[null],pl),M=r.axes=wl(s.axes||[],fl,dl,!0),S=r.scales={},k=r.bands=s.bands||[];k.forEach(u=>{u.fill=se(u.fill||null),u.dir=ae(u.dir,-1)});let P=i==2?x[1].facets[0].scale:x[0].scale,F={axes:dh,series:lh},V=(s.drawOrder||["axes","series"]).map(u=>F[u]);function B(u){let m=u.distr==3?v=>Xt(v>0?v:u.clamp(r,v,u.min,u.max,u.key)):u.distr==4?v=>zn(v,u.asinh):u.distr==100?v=>u.fwd(v):v=>v;return v=>{let g=m(v),{_min:b,_max:A}=u,T=A-b;return(g-b)/T}}function O(u){let m=S[u];if(m==null){let v=(s.scales||Ts)[u]||Ts;if(v.from!=null){O(v.from);let g=Fe({},S[v.from],v,{key:u});g.valToPct=B(g),S[u]=g}else{m=S[u]=Fe({},u==P?Kl:_m,v),m.key=u;let g=m.time,b=m.range,A=ir(b);if((u!=P||i==2&&!g)&&(A&&(b[0]==null||b[1]==null)&&(b={min:b[0]==null?Ko:{mode:1,hard:b[0],soft:b[0]},max:b[1]==null?Ko:{mode:1,hard:b[1],soft:b[1]}},A=!1),!A&&ui(b))){let T=b;b=(L,I,C)=>I==null?rs:ai(I,C,T)}m.range=se(b||(g?Im:u==P?m.distr==3?Fm:m.distr==4?Cm:ac:m.distr==3?oc:m.distr==4?lc:km)),m.auto=se(A?!1:m.auto),m.clamp=se(m.clamp||gm),m._min=m._max=null,m.valToPct=B(m)}}}O("x"),O("y"),i==1&&x.forEach(u=>{O(u.scale)}),M.forEach(u=>{O(u.scale)});for(let u in s.scales)O(u);let R=S[P],H=R.distr,U,X;R.ori==0?(dt(c,Hh),U=n,X=a):(dt(c,Yh),U=a,X=n);let W={};for(let u in S){let m=S[u];(m.min!=null||m.max!=null)&&(W[u]={min:m.min,max:m.max},m.min=m.max=null)}let Z=s.tzDate||(u=>new Date(Ne(u/E))),j=s.fmtDate||la,tt=E==1?Hd(Z):Xd(Z),Ee=ol(Z,al(E==1?Wd:qd,j)),ie=cl(Z,ll($d,j)),he=[],te=r.legend=Fe({},Jd,s.legend),Y=r.cursor=Fe({},im,{drag:{y:i==2}},s.cursor),Ce=te.show,je=Y.show,Ae=te.markers;te.idxs=he,Ae.width=se(Ae.width),Ae.dash=se(Ae.dash),Ae.stroke=se(Ae.stroke),Ae.fill=se(Ae.fill);let fe,St,ot,Te=[],Ot=[],Wt,vt=!1,Qt={};if(te.live){let u=x[1]?x[1].values:null;vt=u!=null,Wt=vt?u(r,1,0):{_:0};for(let m in Wt)Qt[m]=ra}if(Ce)if(fe=Pt("table",td,c),ot=Pt("tbody",null,fe),te.mount(r,fe),vt){St=Pt("thead",null,fe,ot);let u=Pt("tr",null,St);Pt("th",null,u);for(var Rr in Wt)Pt("th",Do,u).textContent=Rr}else dt(fe,sd),te.live&&dt(fe,rd);let Lr={show:!0},hs={show:!1};function Us(u,m){if(m==0&&(vt||!te.live||i==2))return rs;let v=[],g=Pt("tr",id,ot,ot.childNodes[m]);dt(g,u.class),u.show||dt(g,xr);let b=Pt("th",null,g);if(Ae.show){let L=Et(nd,b);if(m>0){let I=Ae.width(r,m);I&&(L.style.border=I+"px "+Ae.dash(r,m)+" "+Ae.stroke(r,m)),L.style.background=Ae.fill(r,m)}}let A=Et(Do,b);u.label instanceof HTMLElement?A.appendChild(u.label):A.textContent=u.label,m>0&&(Ae.show||(A.style.color=u.width>0?Ae.stroke(r,m):Ae.fill(r,m)),$e("click",b,L=>{if(Y._lock)return;mr(L);let I=x.indexOf(u);if((L.ctrlKey||L.metaKey)!=te.isolate){let C=x.some((N,G)=>G>0&&G!=I&&N.show);x.forEach((N,G)=>{G>0&&Vt(G,C?G==I?Lr:hs:Lr,!0,ke.setSeries)})}else Vt(I,{show:!u.show},!0,ke.setSeries)},!1),Fr&&$e(zo,b,L=>{Y._lock||(mr(L),Vt(x.indexOf(u),Yr,!0,ke.setSeries))},!1));for(var T in Wt){let L=Pt("td",ad,g);L.textContent="--",v.push(L)}return[g,v]}let cr=new Map;function $e(u,m,v,g=!0){let b=cr.get(m)||{},A=Y.bind[u](r,m,v,g);A&&(Er(u,m,b[u]=A),cr.set(m,b))}function Pr(u,m,v){let g=cr.get(m)||{};for(let b in g)(u==null||b==u)&&(jn(b,m,g[b]),delete g[b]);u==null&&cr.delete(m)}let Ht=0,fr=0,ee=0,D=0,ge=0,Oe=0,Ir=ge,ur=Oe,Nt=ee,hr=D,lt=0,gt=0,rt=0,Mt=0;r.bbox={};let on=!1,Gs=!1,kr=!1,dr=!1,zs=!1,_t=!1;function ln(u,m,v){(v||u!=r.width||m!=r.height)&&Ba(u,m),Vr(!1),kr=!0,Gs=!0,Ur()}function Ba(u,m){r.width=Ht=ee=u,r.height=fr=D=m,ge=Oe=0,th(),rh();let v=r.bbox;lt=v.left=br(ge*ce,.5),gt=v.top=br(Oe*ce,.5),rt=v.width=br(ee*ce,.5),Mt=v.height=br(D*ce,.5)}let Ju=3;function Zu(){let u=!1,m=0;for(;!u;){m++;let v=uh(m),g=hh(m);u=m==Ju||v&&g,u||(Ba(r.width,r.height),Gs=!0)}}function eh({width:u,height:m}){ln(u,m)}r.setSize=eh;function th(){let u=!1,m=!1,v=!1,g=!1;M.forEach((b,A)=>{if(b.show&&b._show){let{side:T,_size:L}=b,I=T%2,C=b.label!=null?b.labelSize:0,N=L+C;N>0&&(I?(ee-=N,T==3?(ge+=N,g=!0):v=!0):(D-=N,T==0?(Oe+=N,u=!0):m=!0))}}),pr[0]=u,pr[1]=v,pr[2]=m,pr[3]=g,ee-=Jt[1]+Jt[3],ge+=Jt[3],D-=Jt[2]+Jt[0],Oe+=Jt[0]}function rh(){let u=ge+ee,m=Oe+D,v=ge,g=Oe;function b(A,T){switch(A){case 1:return u+=T,u-T;case 2:return m+=T,m-T;case 3:return v-=T,v+T;case 0:return g-=T,g+T}}M.forEach((A,T)=>{if(A.show&&A._show){let L=A.side;A._pos=b(L,A._size),A.label!=null&&(A._lpos=b(L,A.labelSize))}})}if(Y.dataIdx==null){let u=Y.hover,m=u.skip=new Set(u.skip??[]);m.add(void 0);let v=u.prox=se(u.prox),g=u.bias??=0;Y.dataIdx=(b,A,T,L)=>{if(A==0)return T;let I=T,C=v(b,A,T,L)??pe,N=C>=0&&C<pe,G=R.ori==0?ee:D,J=Y.left,oe=e[0],ne=e[A];if(m.has(ne[T])){I=null;let re=null,K=null,q;if(g==0||g==-1)for(q=T;re==null&&q-- >0;)m.has(ne[q])||(re=q);if(g==0||g==1)for(q=T;K==null&&q++<ne.length;)m.has(ne[q])||(K=q);if(re!=null||K!=null)if(N){let be=re==null?-1/0:U(oe[re],R,G,0),Le=K==null?1/0:U(oe[K],R,G,0),We=J-be,de=Le-J;We<=de?We<=C&&(I=re):de<=C&&(I=K)}else I=K==null?re:re==null?K:T-re<=K-T?re:K}else N&&De(J-U(oe[T],R,G,0))>C&&(I=null);return I}}let mr=u=>{Y.event=u};Y.idxs=he,Y._lock=!1;let Xe=Y.points;Xe.show=se(Xe.show),Xe.size=se(Xe.size),Xe.stroke=se(Xe.stroke),Xe.width=se(Xe.width),Xe.fill=se(Xe.fill);let Dt=r.focus=Fe({},s.focus||{alpha:.3},Y.focus),Fr=Dt.prox>=0,Cr=Fr&&Xe.one,yt=[],Or=[],Nr=[];function Wa(u,m){let v=Xe.show(r,m);if(v instanceof HTMLElement)return dt(v,ed),dt(v,u.class),Bt(v,-10,-10,ee,D),_.insertBefore(v,yt[m]),v}function Ha(u,m){if(i==1||m>0){let v=i==1&&S[u.scale].time,g=u.value;u.value=v?rl(g)?cl(Z,ll(g,j)):g||ie:g||mm,u.label=u.label||(v?am:nm)}if(Cr||m>0){u.width=u.width==null?1:u.width,u.paths=u.paths||Rm||_d,u.fillTo=se(u.fillTo||ym),u.pxAlign=+ae(u.pxAlign,y),u.pxRound=_l(u.pxAlign),u.stroke=se(u.stroke||null),u.fill=se(u.fill||null),u._stroke=u._fill=u._paths=u._focus=null;let v=pm(et(1,u.width),1),g=u.points=Fe({},{size:v,width:et(1,v*.2),stroke:u.stroke,space:v*2,paths:Lm,_stroke:null,_fill:null},u.points);g.show=se(g.show),g.filter=se(g.filter),g.fill=se(g.fill),g.stroke=se(g.stroke),g.paths=se(g.paths),g.pxAlign=u.pxAlign}if(Ce){let v=Us(u,m);Te.splice(m,0,v[0]),Ot.splice(m,0,v[1]),te.values.push(null)}if(je){he.splice(m,0,null);let v=null;Cr?m==0&&(v=Wa(u,m)):m>0&&(v=Wa(u,m)),yt.splice(m,0,v),Or.splice(m,0,0),Nr.splice(m,0,0)}Be("addSeries",m)}function sh(u,m){m=m??x.length,u=i==1?ea(u,m,ul,vl):ea(u,m,{},pl),x.splice(m,0,u),Ha(x[m],m)}r.addSeries=sh;function ih(u){if(x.splice(u,1),Ce){te.values.splice(u,1),Ot.splice(u,1);let m=Te.splice(u,1)[0];Pr(null,m.firstChild),m.remove()}je&&(he.splice(u,1),yt.splice(u,1)[0].remove(),Or.splice(u,1),Nr.splice(u,1)),Be("delSeries",u)}r.delSeries=ih;let pr=[!1,!1,!1,!1];function nh(u,m){if(u._show=u.show,u.show){let v=u.side%2,g=S[u.scale];g==null&&(u.scale=v?x[1].scale:P,g=S[u.scale]);let b=g.time;u.size=se(u.size),u.space=se(u.space),u.rotate=se(u.rotate),ir(u.incrs)&&u.incrs.forEach(T=>{!nr.has(T)&&nr.set(T,Il(T))}),u.incrs=se(u.incrs||(g.distr==2?Gd:b?E==1?Bd:Yd:wr)),u.splits=se(u.splits||(b&&g.distr==1?tt:g.distr==3?Kn:g.distr==4?cm:lm)),u.stroke=se(u.stroke),u.grid.stroke=se(u.grid.stroke),u.ticks.stroke=se(u.ticks.stroke),u.border.stroke=se(u.border.stroke);let A=u.values;u.values=ir(A)&&!ir(A[0])?se(A):b?ir(A)?ol(Z,al(A,j)):rl(A)?jd(Z,A):A||Ee:A||om,u.filter=se(u.filter||(g.distr>=3&&g.log==10?hm:g.distr==3&&g.log==2?dm:Ll)),u.font=xl(u.font),u.labelFont=xl(u.labelFont),u._size=u.size(r,null,m,0),u._space=u._rotate=u._incrs=u._found=u._splits=u._values=null,u._size>0&&(pr[m]=!0,u._el=Et(Kh,d))}}function ds(u,m,v,g){let[b,A,T,L]=v,I=m%2,C=0;return I==0&&(L||A)&&(C=m==0&&!b||m==2&&!T?Ne(fl.size/3):0),I==1&&(b||T)&&(C=m==1&&!A||m==3&&!L?Ne(dl.size/2):0),C}let Ya=r.padding=(s.padding||[ds,ds,ds,ds]).map(u=>se(ae(u,ds))),Jt=r._padding=Ya.map((u,m)=>u(r,m,pr,0)),Ye,Ve=null,Ue=null,Bs=i==1?x[0].idxs:null,Tt=null,ms=!1;function qa(u,m){if(e=u??[],r.data=r._data=e,i==2){Ye=0;for(let v=1;v<x.length;v++)Ye+=e[v][0].length}else{e.length==0&&(r.data=r._data=e=[[]]),Tt=e[0],Ye=Tt.length;let v=e;if(H==2){v=e.slice();let g=v[0]=Array(Ye);for(let b=0;b<Ye;b++)g[b]=b}r._data=e=v}if(Vr(!0),Be("setData"),H==2&&(kr=!0),m!==!1){let v=R;v.auto(r,ms)?cn():er(P,v.min,v.max),dr=dr||Y.left>=0,_t=!0,Ur()}}r.setData=qa;function cn(){ms=!0;let u,m;i==1&&(Ye>0?(Ve=Bs[0]=0,Ue=Bs[1]=Ye-1,u=e[0][Ve],m=e[0][Ue],H==2?(u=Ve,m=Ue):u==m&&(H==3?[u,m]=ci(u,u,R.log,!1):H==4?[u,m]=ia(u,u,R.log,!1):R.time?m=u+Ne(86400/E):[u,m]=ai(u,m,na,!0))):(Ve=Bs[0]=u=null,Ue=Bs[1]=m=null)),er(P,u,m)}let Ws,Dr,fn,un,hn,dn,mn,pn,vn,st;function Xa(u,m,v,g,b,A){u??=Uo,v??=oa,g??="butt",b??=Uo,A??="round",u!=Ws&&(f.strokeStyle=Ws=u),b!=Dr&&(f.fillStyle=Dr=b),m!=fn&&(f.lineWidth=fn=m),A!=hn&&(f.lineJoin=hn=A),g!=dn&&(f.lineCap=dn=g),v!=un&&f.setLineDash(un=v)}function ja(u,m,v,g){m!=Dr&&(f.fillStyle=Dr=m),u!=mn&&(f.font=mn=u),v!=pn&&(f.textAlign=pn=v),g!=vn&&(f.textBaseline=vn=g)}function gn(u,m,v,g,b=0){if(g.length>0&&u.auto(r,ms)&&(m==null||m.min==null)){let A=ae(Ve,0),T=ae(Ue,g.length-1),L=v.min==null?hd(g,A,T,b,u.distr==3):[v.min,v.max];u.min=kt(u.min,v.min=L[0]),u.max=et(u.max,v.max=L[1])}}let $a={min:null,max:null};function ah(){for(let g in S){let b=S[g];W[g]==null&&(b.min==null||W[P]!=null&&b.auto(r,ms))&&(W[g]=$a)}for(let g in S){let b=S[g];W[g]==null&&b.from!=null&&W[b.from]!=null&&(W[g]=$a)}W[P]!=null&&Vr(!0);let u={};for(let g in W){let b=W[g];if(b!=null){let A=u[g]=ss(S[g],wd);if(b.min!=null)Fe(A,b);else if(g!=P||i==2)if(Ye==0&&A.from==null){let T=A.range(r,null,null,g);A.min=T[0],A.max=T[1]}else A.min=pe,A.max=-pe}}if(Ye>0){x.forEach((g,b)=>{if(i==1){let A=g.scale,T=W[A];if(T==null)return;let L=u[A];if(b==0){let I=L.range(r,L.min,L.max,A);L.min=I[0],L.max=I[1],Ve=It(L.min,e[0]),Ue=It(L.max,e[0]),Ue-Ve>1&&(e[0][Ve]<L.min&&Ve++,e[0][Ue]>L.max&&Ue--),g.min=Tt[Ve],g.max=Tt[Ue]}else g.show&&g.auto&&gn(L,T,g,e[b],g.sorted);g.idxs[0]=Ve,g.idxs[1]=Ue}else if(b>0&&g.show&&g.auto){let[A,T]=g.facets,L=A.scale,I=T.scale,[C,N]=e[b],G=u[L],J=u[I];G!=null&&gn(G,W[L],A,C,A.sorted),J!=null&&gn(J,W[I],T,N,T.sorted),g.min=T.min,g.max=T.max}});for(let g in u){let b=u[g],A=W[g];if(b.from==null&&(A==null||A.min==null)){let T=b.range(r,b.min==pe?null:b.min,b.max==-pe?null:b.max,g);b.min=T[0],b.max=T[1]}}}for(let g in u){let b=u[g];if(b.from!=null){let A=u[b.from];if(A.min==null)b.min=b.max=null;else{let T=b.range(r,A.min,A.max,g);b.min=T[0],b.max=T[1]}}}let m={},v=!1;for(let g in u){let b=u[g],A=S[g];if(A.min!=b.min||A.max!=b.max){A.min=b.min,A.max=b.max;let T=A.distr;A._min=T==3?Xt(A.min):T==4?zn(A.min,A.asinh):T==100?A.fwd(A.min):A.min,A._max=T==3?Xt(A.max):T==4?zn(A.max,A.asinh):T==100?A.fwd(A.max):A.max,m[g]=v=!0}}if(v){x.forEach((g,b)=>{i==2?b>0&&m.y&&(g._paths=null):m[g.scale]&&(g._paths=null)});for(let g in m)kr=!0,Be("setScale",g);je&&Y.left>=0&&(dr=_t=!0)}for(let g in W)W[g]=null}function oh(u){let m=$n(Ve-1,0,Ye-1),v=$n(Ue+1,0,Ye-1);for(;u[m]==null&&m>0;)m--;for(;u[v]==null&&v<Ye-1;)v++;return[m,v]}function lh(){if(Ye>0){let u=x.some(m=>m._focus)&&st!=Dt.alpha;u&&(f.globalAlpha=st=Dt.alpha),x.forEach((m,v)=>{if(v>0&&m.show&&(Ka(v,!1),Ka(v,!0),m._paths==null)){let g=st;st!=m.alpha&&(f.globalAlpha=st=m.alpha);let b=i==2?[0,e[v][0].length-1]:oh(e[v]);m._paths=m.paths(r,v,b[0],b[1]),st!=g&&(f.globalAlpha=st=g)}}),x.forEach((m,v)=>{if(v>0&&m.show){let g=st;st!=m.alpha&&(f.globalAlpha=st=m.alpha),m._paths!=null&&Qa(v,!1);{let b=m._paths!=null?m._paths.gaps:null,A=m.points.show(r,v,Ve,Ue,b),T=m.points.filter(r,v,A,b);(A||T)&&(m.points._paths=m.points.paths(r,v,Ve,Ue,T),Qa(v,!0))}st!=g&&(f.globalAlpha=st=g),Be("drawSeries",v)}}),u&&(f.globalAlpha=st=1)}}function Ka(u,m){let v=m?x[u].points:x[u];v._stroke=v.stroke(r,u),v._fill=v.fill(r,u)}function Qa(u,m){let v=m?x[u].points:x[u],{stroke:g,fill:b,clip:A,flags:T,_stroke:L=v._stroke,_fill:I=v._fill,_width:C=v.width}=v._paths;C=ve(C*ce,3);let N=null,G=C%2/2;m&&I==null&&(I=C>0?"#fff":L);let J=v.pxAlign==1&&G>0;if(J&&f.translate(G,G),!m){let oe=lt-C/2,ne=gt-C/2,re=rt+C,K=Mt+C;N=new Path2D,N.rect(oe,ne,re,K)}m?_n(L,C,v.dash,v.cap,I,g,b,T,A):ch(u,L,C,v.dash,v.cap,I,g,b,T,N,A),J&&f.translate(-G,-G)}function ch(u,m,v,g,b,A,T,L,I,C,N){let G=!1;I!=0&&k.forEach((J,oe)=>{if(J.series[0]==u){let ne=x[J.series[1]],re=e[J.series[1]],K=(ne._paths||Ts).band;ir(K)&&(K=J.dir==1?K[0]:K[1]);let q,be=null;ne.show&&K&&md(re,Ve,Ue)?(be=J.fill(r,oe)||A,q=ne._paths.clip):K=null,_n(m,v,g,b,be,T,L,I,C,N,q,K),G=!0}}),G||_n(m,v,g,b,A,T,L,I,C,N)}let Ja=is|Jn;function _n(u,m,v,g,b,A,T,L,I,C,N,G){Xa(u,m,v,g,b),(I||C||G)&&(f.save(),I&&f.clip(I),C&&f.clip(C)),G?(L&Ja)==Ja?(f.clip(G),N&&f.clip(N),Ys(b,T),Hs(u,A,m)):L&Jn?(Ys(b,T),f.clip(G),Hs(u,A,m)):L&is&&(f.save(),f.clip(G),N&&f.clip(N),Ys(b,T),f.restore(),Hs(u,A,m)):(Ys(b,T),Hs(u,A,m)),(I||C||G)&&f.restore()}function Hs(u,m,v){v>0&&(m instanceof Map?m.forEach((g,b)=>{f.strokeStyle=Ws=b,f.stroke(g)}):m!=null&&u&&f.stroke(m))}function Ys(u,m){m instanceof Map?m.forEach((v,g)=>{f.fillStyle=Dr=g,f.fill(v)}):m!=null&&u&&f.fill(m)}function fh(u,m,v,g){let b=M[u],A;if(g<=0)A=[0,0];else{let T=b._space=b.space(r,u,m,v,g),L=b._incrs=b.incrs(r,u,m,v,g,T);A=Om(m,v,L,g,T)}return b._found=A}function yn(u,m,v,g,b,A,T,L,I,C){let N=T%2/2;y==1&&f.translate(N,N),Xa(L,T,I,C,L),f.beginPath();let G,J,oe,ne,re=b+(g==0||g==3?-A:A);v==0?(J=b,ne=re):(G=b,oe=re);for(let K=0;K<u.length;K++)m[K]!=null&&(v==0?G=oe=u[K]:J=ne=u[K],f.moveTo(G,J),f.lineTo(oe,ne));f.stroke(),y==1&&f.translate(-N,-N)}function uh(u){let m=!0;return M.forEach((v,g)=>{if(!v.show)return;let b=S[v.scale];if(b.min==null){v._show&&(m=!1,v._show=!1,Vr(!1));return}else v._show||(m=!1,v._show=!0,Vr(!1));let A=v.side,T=A%2,{min:L,max:I}=b,[C,N]=fh(g,L,I,T==0?ee:D);if(N==0)return;let G=b.distr==2,J=v._splits=v.splits(r,g,L,I,C,N,G),oe=b.distr==2?J.map(q=>Tt[q]):J,ne=b.distr==2?Tt[J[1]]-Tt[J[0]]:C,re=v._values=v.values(r,v.filter(r,oe,g,N,ne),g,N,ne);v._rotate=A==2?v.rotate(r,re,g,N):0;let K=v._size;v._size=At(v.size(r,re,g,u)),K!=null&&v._size!=K&&(m=!1)}),m}function hh(u){let m=!0;return Ya.forEach((v,g)=>{let b=v(r,g,pr,u);b!=Jt[g]&&(m=!1),Jt[g]=b}),m}function dh(){for(let u=0;u<M.length;u++){let m=M[u];if(!m.show||!m._show)continue;let v=m.side,g=v%2,b,A,T=m.stroke(r,u),L=v==0||v==3?-1:1,[I,C]=m._found;if(m.label!=null){let Qe=m.labelGap*L,ut=Ne((m._lpos+Qe)*ce);ja(m.labelFont[0],T,"center",v==2?"top":Vo),f.save(),g==1?(b=A=0,f.translate(ut,Ne(gt+Mt/2)),f.rotate((v==3?-ii:ii)/2)):(b=Ne(lt+rt/2),A=ut);let _r=Tl(m.label)?m.label(r,u,I,C):m.label;f.fillText(_r,b,A),f.restore()}if(C==0)continue;let N=S[m.scale],G=g==0?rt:Mt,J=g==0?lt:gt,oe=m._splits,ne=N.distr==2?oe.map(Qe=>Tt[Qe]):oe,re=N.distr==2?Tt[oe[1]]-Tt[oe[0]]:I,K=m.ticks,q=m.border,be=K.show?K.size:0,Le=Ne(be*ce),We=Ne((m.alignTo==2?m._size-be-m.gap:m.gap)*ce),de=m._rotate*-ii/180,Pe=w(m._pos*ce),ct=(Le+We)*L,Ke=Pe+ct;A=g==0?Ke:0,b=g==1?Ke:0;let bt=m.font[0],Rt=m.align==1?Jr:m.align==2?Vn:de>0?Jr:de<0?Vn:g==0?"center":v==3?Vn:Jr,Gt=de||g==1?"middle":v==2?"top":Vo;ja(bt,T,Rt,Gt);let ft=m.font[1]*m.lineGap,wt=oe.map(Qe=>w(o(Qe,N,G,J))),Lt=m._values;for(let Qe=0;Qe<Lt.length;Qe++){let ut=Lt[Qe];if(ut!=null){g==0?b=wt[Qe]:A=wt[Qe],ut=""+ut;let _r=ut.indexOf(`
`)==-1?[ut]:ut.split(/\n/gm);for(let Je=0;Je<_r.length;Je++){let _o=_r[Je];de?(f.save(),f.translate(b,A+Je*ft),f.rotate(de),f.fillText(_o,0,0),f.restore()):f.fillText(_o,b,A+Je*ft)}}}K.show&&yn(wt,K.filter(r,ne,u,C,re),g,v,Pe,Le,ve(K.width*ce,3),K.stroke(r,u),K.dash,K.cap);let zt=m.grid;zt.show&&yn(wt,zt.filter(r,ne,u,C,re),g,g==0?2:1,g==0?gt:lt,g==0?Mt:rt,ve(zt.width*ce,3),zt.stroke(r,u),zt.dash,zt.cap),q.show&&yn([Pe],[1],g==0?1:0,g==0?1:2,g==1?gt:lt,g==1?Mt:rt,ve(q.width*ce,3),q.stroke(r,u),q.dash,q.cap)}Be("drawAxes")}function Vr(u){x.forEach((m,v)=>{v>0&&(m._paths=null,u&&(i==1?(m.min=null,m.max=null):m.facets.forEach(g=>{g.min=null,g.max=null})))})}let qs=!1,bn=!1,ps=[];function mh(){bn=!1;for(let u=0;u<ps.length;u++)Be(...ps[u]);ps.length=0}function Ur(){qs||(Rd(Za),qs=!0)}function ph(u,m=!1){qs=!0,bn=m,u(r),Za(),m&&ps.length>0&&queueMicrotask(mh)}r.batch=ph;function Za(){if(on&&(ah(),on=!1),kr&&(Zu(),kr=!1),Gs){if(xe(p,Jr,ge),xe(p,"top",Oe),xe(p,Es,ee),xe(p,As,D),xe(_,Jr,ge),xe(_,"top",Oe),xe(_,Es,ee),xe(_,As,D),xe(d,Es,Ht),xe(d,As,fr),h.width=Ne(Ht*ce),h.height=Ne(fr*ce),M.forEach(({_el:u,_show:m,_size:v,_pos:g,side:b})=>{if(u!=null)if(m){let A=b===3||b===0?v:0,T=b%2==1;xe(u,T?"left":"top",g-A),xe(u,T?"width":"height",v),xe(u,T?"top":"left",T?Oe:ge),xe(u,T?"height":"width",T?D:ee),Xn(u,xr)}else dt(u,xr)}),Ws=Dr=fn=hn=dn=mn=pn=vn=un=null,st=1,_s(!0),ge!=Ir||Oe!=ur||ee!=Nt||D!=hr){Vr(!1);let u=ee/Nt,m=D/hr;if(je&&!dr&&Y.left>=0){Y.left*=u,Y.top*=m,Gr&&Bt(Gr,Ne(Y.left),0,ee,D),zr&&Bt(zr,0,Ne(Y.top),ee,D);for(let v=0;v<yt.length;v++){let g=yt[v];g!=null&&(Or[v]*=u,Nr[v]*=m,Bt(g,At(Or[v]),At(Nr[v]),ee,D))}}if(ye.show&&!zs&&ye.left>=0&&ye.width>0){ye.left*=u,ye.width*=u,ye.top*=m,ye.height*=m;for(let v in Mn)xe(Hr,v,ye[v])}Ir=ge,ur=Oe,Nt=ee,hr=D}Be("setSize"),Gs=!1}Ht>0&&fr>0&&(f.clearRect(0,0,h.width,h.height),Be("drawClear"),V.forEach(u=>u()),Be("draw")),ye.show&&zs&&(Xs(ye),zs=!1),je&&dr&&(gr(null,!0,!1),dr=!1),te.show&&te.live&&_t&&(An(),_t=!1),l||(l=!0,r.status=1,Be("ready")),ms=!1,qs=!1}r.redraw=(u,m)=>{kr=m||!1,u!==!1?er(P,R.min,R.max):Ur()};function wn(u,m){let v=S[u];if(v.from==null){if(Ye==0){let g=v.range(r,m.min,m.max,u);m.min=g[0],m.max=g[1]}if(m.min>m.max){let g=m.min;m.min=m.max,m.max=g}if(Ye>1&&m.min!=null&&m.max!=null&&m.max-m.min<1e-16)return;u==P&&v.distr==2&&Ye>0&&(m.min=It(m.min,e[0]),m.max=It(m.max,e[0]),m.min==m.max&&m.max++),W[u]=m,on=!0,Ur()}}r.setScale=wn;let xn,En,Gr,zr,eo,to,Br,Wr,ro,so,_e,Se,Zt=!1,qe=Y.drag,Ge=qe.x,ze=qe.y;je&&(Y.x&&(xn=Et(Jh,_)),Y.y&&(En=Et(Zh,_)),R.ori==0?(Gr=xn,zr=En):(Gr=En,zr=xn),_e=Y.left,Se=Y.top);let ye=r.select=Fe({show:!0,over:!0,left:0,width:0,top:0,height:0},s.select),Hr=ye.show?Et(Qh,ye.over?_:p):null;function Xs(u,m){if(ye.show){for(let v in u)ye[v]=u[v],v in Mn&&xe(Hr,v,u[v]);m!==!1&&Be("setSelect")}}r.setSelect=Xs;function vh(u){if(x[u].show)Ce&&Xn(Te[u],xr);else if(Ce&&dt(Te[u],xr),je){let v=Cr?yt[0]:yt[u];v!=null&&Bt(v,-10,-10,ee,D)}}function er(u,m,v){wn(u,{min:m,max:v})}function Vt(u,m,v,g){m.focus!=null&&wh(u),m.show!=null&&x.forEach((b,A)=>{A>0&&(u==A||u==null)&&(b.show=m.show,vh(A),i==2?(er(b.facets[0].scale,null,null),er(b.facets[1].scale,null,null)):er(b.scale,null,null),Ur())}),v!==!1&&Be("setSeries",u,m),g&&ys("setSeries",r,u,m)}r.setSeries=Vt;function gh(u,m){Fe(k[u],m)}function _h(u,m){u.fill=se(u.fill||null),u.dir=ae(u.dir,-1),m=m??k.length,k.splice(m,0,u)}function yh(u){u==null?k.length=0:k.splice(u,1)}r.addBand=_h,r.setBand=gh,r.delBand=yh;function bh(u,m){x[u].alpha=m,je&&yt[u]!=null&&(yt[u].style.opacity=m),Ce&&Te[u]&&(Te[u].style.opacity=m)}let Yt,tr,vr,Yr={focus:!0};function wh(u){if(u!=vr){let m=u==null,v=Dt.alpha!=1;x.forEach((g,b)=>{if(i==1||b>0){let A=m||b==0||b==u;g._focus=m?null:A,v&&bh(b,A?1:Dt.alpha)}}),vr=u,v&&Ur()}}Ce&&Fr&&$e(Bo,fe,u=>{Y._lock||(mr(u),vr!=null&&Vt(null,Yr,!0,ke.setSeries))});function Ut(u,m,v){let g=S[m];v&&(u=u/ce-(g.ori==1?Oe:ge));let b=ee;g.ori==1&&(b=D,u=b-u),g.dir==-1&&(u=b-u);let A=g._min,T=g._max,L=u/b,I=A+(T-A)*L,C=g.distr;return C==3?ts(10,I):C==4?vd(I,g.asinh):C==100?g.bwd(I):I}function xh(u,m){let v=Ut(u,P,m);return It(v,e[0],Ve,Ue)}r.valToIdx=u=>It(u,e[0]),r.posToIdx=xh,r.posToVal=Ut,r.valToPos=(u,m,v)=>S[m].ori==0?n(u,S[m],v?rt:ee,v?lt:0):a(u,S[m],v?Mt:D,v?gt:0),r.setCursor=(u,m,v)=>{_e=u.left,Se=u.top,gr(null,m,v)};function io(u,m){xe(Hr,Jr,ye.left=u),xe(Hr,Es,ye.width=m)}function no(u,m){xe(Hr,"top",ye.top=u),xe(Hr,As,ye.height=m)}let vs=R.ori==0?io:no,gs=R.ori==1?io:no;function Eh(){if(Ce&&te.live)for(let u=i==2?1:0;u<x.length;u++){if(u==0&&vt)continue;let m=te.values[u],v=0;for(let g in m)Ot[u][v++].firstChild.nodeValue=m[g]}}function An(u,m){if(u!=null&&(u.idxs?u.idxs.forEach((v,g)=>{he[g]=v}):bd(u.idx)||he.fill(u.idx),te.idx=he[0]),Ce&&te.live){for(let v=0;v<x.length;v++)(v>0||i==1&&!vt)&&Ah(v,he[v]);Eh()}_t=!1,m!==!1&&Be("setLegend")}r.setLegend=An;function Ah(u,m){let v=x[u],g=u==0&&H==2?Tt:e[u],b;vt?b=v.values(r,u,m)??Qt:(b=v.value(r,m==null?null:g[m],u,m),b=b==null?Qt:{_:b}),te.values[u]=b}function gr(u,m,v){ro=_e,so=Se,[_e,Se]=Y.move(r,_e,Se),Y.left=_e,Y.top=Se,je&&(Gr&&Bt(Gr,Ne(_e),0,ee,D),zr&&Bt(zr,0,Ne(Se),ee,D));let g,b=Ve>Ue;Yt=pe,tr=null;let A=R.ori==0?ee:D,T=R.ori==1?ee:D;if(_e<0||Ye==0||b){g=Y.idx=null;for(let L=0;L<x.length;L++){let I=yt[L];I!=null&&Bt(I,-10,-10,ee,D)}Fr&&Vt(null,Yr,!0,u==null&&ke.setSeries),te.live&&(he.fill(g),_t=!0)}else{let L,I,C;i==1&&(L=R.ori==0?_e:Se,I=Ut(L,P),g=Y.idx=It(I,e[0],Ve,Ue),C=U(e[0][g],R,A,0));let N=-10,G=-10,J=0,oe=0,ne=!0,re="",K="";for(let q=i==2?1:0;q<x.length;q++){let be=x[q],Le=he[q],We=Le==null?null:i==1?e[q][Le]:e[q][1][Le],de=Y.dataIdx(r,q,g,I),Pe=de==null?null:i==1?e[q][de]:e[q][1][de];if(_t=_t||Pe!=We||de!=Le,he[q]=de,q>0&&be.show){let ct=de==null?-10:de==g?C:U(i==1?e[0][de]:e[q][0][de],R,A,0),Ke=Pe==null?-10:X(Pe,i==1?S[be.scale]:S[be.facets[1].scale],T,0);if(Fr&&Pe!=null){let bt=R.ori==1?_e:Se,Rt=De(Dt.dist(r,q,de,Ke,bt));if(Rt<Yt){let Gt=Dt.bias;if(Gt!=0){let ft=Ut(bt,be.scale),wt=Pe>=0?1:-1,Lt=ft>=0?1:-1;Lt==wt&&(Lt==1?Gt==1?Pe>=ft:Pe<=ft:Gt==1?Pe<=ft:Pe>=ft)&&(Yt=Rt,tr=q)}else Yt=Rt,tr=q}}if(_t||Cr){let bt,Rt;R.ori==0?(bt=ct,Rt=Ke):(bt=Ke,Rt=ct);let Gt,ft,wt,Lt,zt,Qe,ut=!0,_r=Xe.bbox;if(_r!=null){ut=!1;let Je=_r(r,q);wt=Je.left,Lt=Je.top,Gt=Je.width,ft=Je.height}else wt=bt,Lt=Rt,Gt=ft=Xe.size(r,q);if(Qe=Xe.fill(r,q),zt=Xe.stroke(r,q),Cr)q==tr&&Yt<=Dt.prox&&(N=wt,G=Lt,J=Gt,oe=ft,ne=ut,re=Qe,K=zt);else{let Je=yt[q];Je!=null&&(Or[q]=wt,Nr[q]=Lt,$o(Je,Gt,ft,ut),Xo(Je,Qe,zt),Bt(Je,At(wt),At(Lt),ee,D))}}}}if(Cr){let q=Dt.prox,be=vr==null?Yt<=q:Yt>q||tr!=vr;if(_t||be){let Le=yt[0];Le!=null&&(Or[0]=N,Nr[0]=G,$o(Le,J,oe,ne),Xo(Le,re,K),Bt(Le,At(N),At(G),ee,D))}}}if(ye.show&&Zt)if(u!=null){let[L,I]=ke.scales,[C,N]=ke.match,[G,J]=u.cursor.sync.scales,oe=u.cursor.drag;if(Ge=oe._x,ze=oe._y,Ge||ze){let{left:ne,top:re,width:K,height:q}=u.select,be=u.scales[G].ori,Le=u.posToVal,We,de,Pe,ct,Ke,bt=L!=null&&C(L,G),Rt=I!=null&&N(I,J);bt&&Ge?(be==0?(We=ne,de=K):(We=re,de=q),Pe=S[L],ct=U(Le(We,G),Pe,A,0),Ke=U(Le(We+de,G),Pe,A,0),vs(kt(ct,Ke),De(Ke-ct))):vs(0,A),Rt&&ze?(be==1?(We=ne,de=K):(We=re,de=q),Pe=S[I],ct=X(Le(We,J),Pe,T,0),Ke=X(Le(We+de,J),Pe,T,0),gs(kt(ct,Ke),De(Ke-ct))):gs(0,T)}else Tn()}else{let L=De(ro-eo),I=De(so-to);if(R.ori==1){let J=L;L=I,I=J}Ge=qe.x&&L>=qe.dist,ze=qe.y&&I>=qe.dist;let C=qe.uni;C!=null?Ge&&ze&&(Ge=L>=C,ze=I>=C,!Ge&&!ze&&(I>L?ze=!0:Ge=!0)):qe.x&&qe.y&&(Ge||ze)&&(Ge=ze=!0);let N,G;Ge&&(R.ori==0?(N=Br,G=_e):(N=Wr,G=Se),vs(kt(N,G),De(G-N)),ze||gs(0,T)),ze&&(R.ori==1?(N=Br,G=_e):(N=Wr,G=Se),gs(kt(N,G),De(G-N)),Ge||vs(0,A)),!Ge&&!ze&&(vs(0,0),gs(0,0))}if(qe._x=Ge,qe._y=ze,u==null){if(v){if(go!=null){let[L,I]=ke.scales;ke.values[0]=L!=null?Ut(R.ori==0?_e:Se,L):null,ke.values[1]=I!=null?Ut(R.ori==1?_e:Se,I):null}ys(Un,r,_e,Se,ee,D,g)}if(Fr){let L=v&&ke.setSeries,I=Dt.prox;vr==null?Yt<=I&&Vt(tr,Yr,!0,L):Yt>I?Vt(null,Yr,!0,L):tr!=vr&&Vt(tr,Yr,!0,L)}}_t&&(te.idx=g,An()),m!==!1&&Be("setCursor")}let rr=null;Object.defineProperty(r,"rect",{get(){return rr==null&&_s(!1),rr}});function _s(u=!1){u?rr=null:(rr=_.getBoundingClientRect(),Be("syncRect",rr))}function ao(u,m,v,g,b,A,T){Y._lock||Zt&&u!=null&&u.movementX==0&&u.movementY==0||(Sn(u,m,v,g,b,A,T,!1,u!=null),u!=null?gr(null,!0,!0):gr(m,!0,!1))}function Sn(u,m,v,g,b,A,T,L,I){if(rr==null&&_s(!1),mr(u),u!=null)v=u.clientX-rr.left,g=u.clientY-rr.top;else{if(v<0||g<0){_e=-10,Se=-10;return}let[C,N]=ke.scales,G=m.cursor.sync,[J,oe]=G.values,[ne,re]=G.scales,[K,q]=ke.match,be=m.axes[0].side%2==1,Le=R.ori==0?ee:D,We=R.ori==1?ee:D,de=be?A:b,Pe=be?b:A,ct=be?g:v,Ke=be?v:g;if(ne!=null?v=K(C,ne)?o(J,S[C],Le,0):-10:v=Le*(ct/de),re!=null?g=q(N,re)?o(oe,S[N],We,0):-10:g=We*(Ke/Pe),R.ori==1){let bt=v;v=g,g=bt}}I&&(m==null||m.cursor.event.type==Un)&&((v<=1||v>=ee-1)&&(v=br(v,ee)),(g<=1||g>=D-1)&&(g=br(g,D))),L?(eo=v,to=g,[Br,Wr]=Y.move(r,v,g)):(_e=v,Se=g)}let Mn={width:0,height:0,left:0,top:0};function Tn(){Xs(Mn,!1)}let oo,lo,co,fo;function uo(u,m,v,g,b,A,T){Zt=!0,Ge=ze=qe._x=qe._y=!1,Sn(u,m,v,g,b,A,T,!0,!1),u!=null&&($e(Gn,Yn,ho,!1),ys(Go,r,Br,Wr,ee,D,null));let{left:L,top:I,width:C,height:N}=ye;oo=L,lo=I,co=C,fo=N}function ho(u,m,v,g,b,A,T){Zt=qe._x=qe._y=!1,Sn(u,m,v,g,b,A,T,!1,!0);let{left:L,top:I,width:C,height:N}=ye,G=C>0||N>0,J=oo!=L||lo!=I||co!=C||fo!=N;if(G&&J&&Xs(ye),qe.setScale&&G&&J){let oe=L,ne=C,re=I,K=N;if(R.ori==1&&(oe=I,ne=N,re=L,K=C),Ge&&er(P,Ut(oe,P),Ut(oe+ne,P)),ze)for(let q in S){let be=S[q];q!=P&&be.from==null&&be.min!=pe&&er(q,Ut(re+K,q),Ut(re,q))}Tn()}else Y.lock&&(Y._lock=!Y._lock,gr(m,!0,u!=null));u!=null&&(Pr(Gn,Yn),ys(Gn,r,_e,Se,ee,D,null))}function Sh(u,m,v,g,b,A,T){if(Y._lock)return;mr(u);let L=Zt;if(Zt){let I=!0,C=!0,N=10,G,J;R.ori==0?(G=Ge,J=ze):(G=ze,J=Ge),G&&J&&(I=_e<=N||_e>=ee-N,C=Se<=N||Se>=D-N),G&&I&&(_e=_e<Br?0:ee),J&&C&&(Se=Se<Wr?0:D),gr(null,!0,!0),Zt=!1}_e=-10,Se=-10,he.fill(null),gr(null,!0,!0),L&&(Zt=L)}function mo(u,m,v,g,b,A,T){Y._lock||(mr(u),cn(),Tn(),u!=null&&ys(Wo,r,_e,Se,ee,D,null))}function po(){M.forEach(Nm),ln(r.width,r.height,!0)}Er(ni,es,po);let qr={};qr.mousedown=uo,qr.mousemove=ao,qr.mouseup=ho,qr.dblclick=mo,qr.setSeries=(u,m,v,g)=>{let b=ke.match[2];v=b(r,m,v),v!=-1&&Vt(v,g,!0,!1)},je&&($e(Go,_,uo),$e(Un,_,ao),$e(zo,_,u=>{mr(u),_s(!1)}),$e(Bo,_,Sh),$e(Wo,_,mo),Zn.add(r),r.syncRect=_s);let js=r.hooks=s.hooks||{};function Be(u,m,v){bn?ps.push([u,m,v]):u in js&&js[u].forEach(g=>{g.call(null,r,m,v)})}(s.plugins||[]).forEach(u=>{for(let m in u.hooks)js[m]=(js[m]||[]).concat(u.hooks[m])});let vo=(u,m,v)=>v,ke=Fe({key:null,setSeries:!1,filters:{pub:el,sub:el},scales:[P,x[1]?x[1].scale:null],match:[tl,tl,vo],values:[null,null]},Y.sync);ke.match.length==2&&ke.match.push(vo),Y.sync=ke;let go=ke.key,Rn=Ql(go);function ys(u,m,v,g,b,A,T){ke.filters.pub(u,m,v,g,b,A,T)&&Rn.pub(u,m,v,g,b,A,T)}Rn.sub(r);function Mh(u,m,v,g,b,A,T){ke.filters.sub(u,m,v,g,b,A,T)&&qr[u](null,m,v,g,b,A,T)}r.pub=Mh;function Th(){Rn.unsub(r),Zn.delete(r),cr.clear(),jn(ni,es,po),c.remove(),fe?.remove(),Be("destroy")}r.destroy=Th;function Ln(){Be("init",s,e),qa(e||s.data,!1),W[P]?wn(P,W[P]):cn(),zs=ye.show&&(ye.width>0||ye.height>0),dr=_t=!0,ln(s.width,s.height)}return x.forEach(Ha),M.forEach(nh),t?t instanceof HTMLElement?(t.appendChild(c),Ln()):t(r,Ln):Ln(),r}He.assign=Fe;He.fmtNum=aa;He.rangeNum=ai;He.rangeLog=ci;He.rangeAsinh=ia;He.orient=Sr;He.pxRatio=ce;He.join=Td;He.fmtDate=la,He.tzDate=Vd;He.sync=Ql;{He.addGap=bm,He.clipGaps=hi;let s=He.paths={points:sc};s.linear=nc,s.stepped=Em,s.bars=Am,s.spline=Mm}var cc=96,Dm=8,vi=["#2f8fef","#e8820c","#1fa367","#a45ee5","#e5484d","#12a5b8","#b58900","#d6409f","#6e7fd9","#7a8b3a"];function pa(s,e){let[t,r]=[0,s.times.length];for(;t<r;){let i=t+r>>1;s.times[i]<=e+1e-4?t=i+1:r=i}return t===0?null:s.values[t-1]}var ar=class{constructor(e,t){this.container=e;this.seek=t;this.set([]),new ResizeObserver(()=>this.resize()).observe(e)}container;seek;charts=[];time=0;set(e){for(let{plot:t}of this.charts)t.destroy();this.container.replaceChildren(),this.charts=e.map((t,r)=>this.chart(t,r))}redraw(){for(let{plot:e}of this.charts)e.redraw(!1)}show(e,t){this.time=e,t.length===this.charts.length&&t.every((i,n)=>i===this.charts[n].curve)||this.set(t);for(let i of this.charts){let n=pa(i.curve,e);i.value.textContent=zm(i.curve,n);let a=i.curve.times.at(-1);i.drawnTime!==a&&(i.drawnTime=a,i.plot.setData([i.curve.times,i.curve.values])),this.moveCursor(i)}}moveCursor({plot:e,cursor:t}){let r=e.valToPos(this.time,"x");t.hidden=!(r>=0&&r<=e.over.clientWidth),t.style.transform=`translateX(${r}px)`}chart(e,t){let r=document.createElement("figure"),i=document.createElement("figcaption"),n=document.createElement("button"),a=document.createElement("output");n.textContent=e.name.replaceAll("_"," "),n.title=`${e.name}: fold or unfold`;let o=h=>{r.classList.toggle("folded",h),n.setAttribute("aria-expanded",String(!h))};n.addEventListener("click",()=>o(!r.classList.contains("folded"))),o(t>=Dm),n.style.setProperty("--mark",vi[t%vi.length]),i.append(n,a),r.append(i),this.container.append(r);let l=new He(this.options(e,vi[t%vi.length]),[e.times,e.values],r);l.over.addEventListener("click",h=>this.seek(l.posToVal(h.offsetX,"x")));let c=document.createElement("i");return c.className="cursor",l.over.append(c),{curve:e,plot:l,cursor:c,value:a,drawnTime:e.times.at(-1)}}options({names:e,isFraction:t},r){let i=a=>getComputedStyle(this.container).getPropertyValue(a).trim(),n=()=>({stroke:()=>i("--soft"),grid:{stroke:()=>i("--line"),width:1},ticks:{show:!1},font:"10px system-ui, sans-serif"});return{width:Math.max(120,this.container.clientWidth-20),height:cc,legend:{show:!1},cursor:{y:!1,drag:{x:!1,y:!1},points:{show:!1}},scales:{x:{time:!1},y:{range:Vm(e,t)}},axes:[{...n(),size:20,gap:2},{...n(),size:44,gap:2,space:12,values:(a,o,l,c,h)=>o.map(f=>Um(f,h)),...e?.length?{incrs:[1,2,5,10]}:{}}],series:[{},{stroke:r,width:1.5,spanGaps:!1,paths:e?.length?He.paths.stepped({align:1}):void 0,points:{show:!0,size:4,fill:r,filter:Gm}}]}}resize(){let e=Math.max(120,this.container.clientWidth-20);for(let t of this.charts)t.plot.setSize({width:e,height:cc}),this.moveCursor(t)}};function Vm(s,e){return s?.length?[0,s.length]:e?[0,1]:(t,r,i)=>{if(r===null||i===null)return[0,1];let n=i-r<1e-5*Math.max(Math.abs(r),Math.abs(i),1e-6);if(n&&r>=0)return[0,i>0?2*i:1];let a=n?Math.max(.5,.1*Math.abs(i)):.08*(i-r);return[r-a,i+a]}}function Um(s,e){let t=[0,1,2,3,4,5].find(r=>Math.abs(e*10**r-Math.round(e*10**r))<1e-6)??9;return Math.abs(s)>=1e5||t>5?s===0?"0":s.toExponential(1):String(Number(s.toFixed(t)))}function Gm(s,e){let t=s.data[e],r=i=>t[i]===null||t[i]===void 0;return[...t.keys()].filter(i=>!r(i)&&r(i-1)&&r(i+1))}function zm({unit:s,names:e},t){return t===null?"–":e?.length?e[t-1]??"none yet":`${Bm(t)} ${s==="1"?"":s}`.trim()}function Bm(s){let e=Math.abs(s);return s===0?"0":e>=1e5||e<.001?s.toExponential(2):s.toPrecision(4)}var va=3e3,Wm=16,gi=class{constructor(e){this.request=e;let t=z("topic");t.addEventListener("change",()=>{this.add(t.value),t.value=""})}request;cards=new Map;types={};list(e){this.types=Object.fromEntries(e);let t=z("topic"),r=e.map(([i,n])=>new Option(`${i}  (${n.replace("/msg/","/")})`,i));t.replaceChildren(new Option("Show a topic…",""),...r),z("topics-box").hidden=!e.length}showMessage(e){this.cards.get(e.name)?.showMessage(e)}show(e){for(let t of this.cards.values())t.show(e)}redrawCurves(){for(let e of this.cards.values())e.curves.redraw()}add(e){if(!e||this.cards.has(e)||this.cards.size>=Wm)return;let t=new ga(e,this.types[e]??"",()=>{this.cards.delete(e),this.request([...this.cards.keys()])});this.cards.set(e,t),z("topics").append(t.box),this.request([...this.cards.keys()])}},ga=class{box=$("div","","topic");curves;rows=new Map;samples=new Map;selection=new Set;table=$("div","","fields");note=$("p","No message yet. A topic without a subscriber may have none.","none");constructor(e,t,r){let[i,n,a]=[$("h3"),$("button","×"),$("div")];n.title=`Hide ${e}`,n.setAttribute("aria-label",n.title),n.addEventListener("click",()=>{this.box.remove(),r()});let o=$("span",e);o.title=t,i.append(o,n),this.box.append(i,this.note,this.table,a),this.curves=new ar(a,()=>{})}showMessage({time:e,fields:t,is_cut:r}){this.note.textContent=r?"The first fields of the message:":"",this.note.hidden=!r;for(let[i,n]of t){let a=this.samples.size===0;typeof n=="number"&&this.store(i,e,n),a&&this.samples.size&&this.selection.add(i);let o=this.rows.get(i)??this.row(i,typeof n=="number");o.value.textContent=typeof n=="number"?String(Number(n.toPrecision(6))):n??"–"}this.mark()}show(e){let t=[...this.samples].filter(([r])=>this.selection.has(r));this.curves.show(e,t.map(([,r])=>r))}store(e,t,r){let i=this.samples.get(e);i||this.samples.set(e,i={name:e,unit:"",times:[],values:[]}),!(t<=(i.times.at(-1)??-1))&&(i.times.push(t),i.values.push(r),!(i.times.length<=va)&&(i.times.splice(0,va/2),i.values.splice(0,va/2)))}row(e,t){let[r,i]=[$(t?"button":"div","","field"),$("output")];r.append($("span",e),i),t&&(r.title="Show or hide its curve",r.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.mark()})),this.table.append(r);let n={row:r,value:i};return this.rows.set(e,n),n}mark(){for(let[e,{row:t}]of this.rows)t instanceof HTMLButtonElement&&t.setAttribute("aria-pressed",String(this.selection.has(e)))}};var Mr=16,Hm=100,Ym=640,_a=class{constructor(e,t,r,i){this.socket=e;this.pack=t;this.earlyEvents=r;this.isServerDrawn=i;e.onclose=()=>this.end("The simulation has ended.")}socket;pack;earlyEvents;isServerDrawn;pilot=new ei((e,t)=>{this.send(e),t&&this.page?.picture.skipPauses()});topics=new gi(e=>this.send({type:"topics",names:e}));page=null;stream=null;lastRequest="";imageNumbers=[];allowsReset=!1;begin(e,t){this.page=e,this.stream=t;for(let r of this.earlyEvents)this.receive(r);this.socket.onmessage=r=>this.receive(r),this.subscribe(e.switches.pictures)}subscribe(e){let t=e?this.pack.head.cameras.map(({name:r})=>r):[];this.send({type:"images",cameras:t,rate:10,width:this.page?.picture.pictureWidth()})}requestView({worldFromCamera:e,camera:t,intrinsics:r}){if(!this.isServerDrawn)return;let i=Math.min(1,Ym/r.width),[n,a]=[r.width,r.height].map(f=>Math.round(i*f)),o=wo(e).map(f=>Math.round(1e4*f)/1e4),l=2*Math.atan(r.height/2/r.fy),c={type:"view",camera:t?.name??null,pose:o,width:n,height:a,fovy:l},h=JSON.stringify(c);h!==this.lastRequest&&this.send(c),this.lastRequest=h}control(e,t){this.send({type:"control",action:e,...t===void 0?{}:{speed:t}})}handlePilotKey(e){return this.pilot.handlePilotKey(e)}helpGroups(){return{Pilot:this.pilot.help()}}send(e){this.socket.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(e))}receive(e){let{page:t,stream:r}=this;if(!t||!r)return;if(typeof e.data=="string")return this.handleMessage(JSON.parse(e.data),t,r);let i=new DataView(e.data),[n,a]=[i.getUint8(0),i.getUint8(1)];n===0&&location.reload(),n===1&&r.push(i.getFloat64(8,!0),new Float32Array(e.data,Mr)),n===2&&this.showImage(a,e.data.slice(Mr),t,r),n===4&&r.setSand(a,new Float32Array(e.data,Mr)),n===5&&this.addMedium(e.data.slice(Mr),t,r),n===6&&r.setPuffs(new Float64Array(e.data,Mr)),n===3&&this.isServerDrawn&&this.showView(e.data.slice(Mr))}async addMedium(e,t,r){let i=await ws(new Uint8Array(e));t.picture.media.add(i,i.head.optics),r.version+=1}handleMessage(e,t,r){if(e.type==="state")t.setState(e.paused,e.speed),this.allowsReset=e.resets,this.pilot.enable(e),t.views.follow(e.vehicle),t.keyboard.showHelp();else if(e.type==="levels")r.setLevels(e.levels);else if(e.type==="samples")for(let i of e.samples)r.sample(...i);else e.type==="readings"?r.version+=Number(t.quantities.setReadings(e.readings)):e.type==="topics"?this.topics.list(e.topics):e.type==="topic"?this.topics.showMessage(e):e.type==="markers"?r.setMarkers(e.markers):e.type==="end"&&this.end(e.why)}async showImage(e,t,r,i){let n=(this.imageNumbers[e]??0)+1;this.imageNumbers[e]=n;let a=await createImageBitmap(new Blob([t],{type:"image/jpeg"}));if(this.imageNumbers[e]!==n)return a.close();r.picture.show(e,a);let{end:o}=i;setTimeout(()=>{i.end===o&&(i.version+=1)},Hm)}showView(e){let t=z("stream");t.hidden=!1,qm(t,e)}end(e){z("message").textContent=e,this.page&&(this.page.isPlaying=!1)}};function qm(s,e){let t=s.src;s.src=URL.createObjectURL(new Blob([e],{type:"image/jpeg"})),t&&URL.revokeObjectURL(t)}function fc(s){let e=location.protocol==="https:"?"wss:":"ws:",t=new WebSocket(`${e}//${location.host}/socket${location.search}`);return t.binaryType="arraybuffer",new Promise((r,i)=>{let n=[],a=!1;t.onerror=t.onclose=()=>i(new Error("The simulation cannot be reached.")),t.onmessage=o=>{let{data:l}=o;if(a||typeof l=="string"||new DataView(l).getUint8(0)!==0){n.push(o);return}a=!0,ws(new Uint8Array(l.slice(Mr))).then(c=>r(new _a(t,c,n,s)),i)}})}var Xm=["clear","dusk","cloudy"],_i=.03,yi=class{constructor(e){this.page=e;let t=z("view");document.addEventListener("keydown",r=>this.onKeyDown(r)),t.addEventListener("keydown",r=>this.turnView(r)),t.addEventListener("pointerdown",r=>{if(r.target.closest("button, .stick"))return;t.setPointerCapture(r.pointerId);let i=r.button!==0||r.shiftKey;this.dragState={x:r.clientX,y:r.clientY,isPan:i}}),t.addEventListener("pointermove",r=>this.drag(r)),t.addEventListener("pointerup",()=>this.dragState=null),t.addEventListener("pointercancel",()=>this.dragState=null),t.addEventListener("contextmenu",r=>r.preventDefault()),t.addEventListener("wheel",r=>{r.preventDefault(),e.views.zoom(Math.exp(.001*r.deltaY))},{passive:!1}),this.showHelp()}page;dragState=null;showHelp(){Co(this.groups())}drag(e){if(!this.dragState)return;let t=z("view").clientHeight,[r,i]=[e.clientX-this.dragState.x,e.clientY-this.dragState.y];this.page.views.drag(r/t,i/t,this.dragState.isPan),Object.assign(this.dragState,{x:e.clientX,y:e.clientY})}turnView(e){let r={ArrowLeft:[_i,0],ArrowRight:[-_i,0],ArrowUp:[0,_i],ArrowDown:[0,-_i]}[e.key];!r||e.ctrlKey||e.altKey||e.metaKey||(e.preventDefault(),e.stopPropagation(),this.page.views.drag(r[0],r[1],e.shiftKey))}onKeyDown(e){let{page:t}=this;if(e.ctrlKey||e.altKey||e.metaKey)return;let r=e.target;if((r instanceof HTMLSelectElement||r instanceof HTMLInputElement)&&!/^[a-z?]$/.test(e.key)||e.key===" "&&r instanceof HTMLButtonElement||/^(Home|End)$/.test(e.key)&&z("help").contains(r)||t.connection?.handlePilotKey(e))return;let n=e.shiftKey?e.key.toLowerCase():e.key,a=this.actions()[n];a&&(e.preventDefault(),a())}actions(){let{page:e}=this,t=i=>()=>{let n=e.player.levels.findIndex(({trial:a,level:o})=>a===e.player.trial&&o.end>e.time);e.go(Math.max(0,(n<0?e.player.levels.length-1:n)+i))},r=i=>()=>{e.switches.sun=Xm[i],e.draw()};return{" ":()=>e.play(),",":()=>e.step(-1),".":()=>e.step(1),ArrowLeft:()=>e.seek(e.time-1),ArrowRight:()=>e.seek(e.time+1),Home:()=>e.seek(e.player.start),End:()=>e.seek(e.player.end),"[":t(-1),"]":t(1),"<":()=>e.changeSpeed(-1),">":()=>e.changeSpeed(1),o:()=>e.show("orbit"),b:()=>e.show("chase"),v:()=>e.show("camera"),m:()=>e.show("map"),p:()=>e.show("file"),z:()=>e.toggle("state"),h:()=>e.views.restoreInitial(),k:()=>e.views.toggleFollowing(),r:()=>e.reset(),"+":()=>e.views.zoom(.9),"=":()=>e.views.zoom(.9),"-":()=>e.views.zoom(1.1),x:()=>e.toggle("clear"),c:()=>e.toggle("pictures"),f:()=>e.toggle("frames"),l:()=>e.toggle("labels"),t:()=>e.toggle("trails"),y:()=>e.clearTrails(),s:()=>e.toggle("sonars"),n:()=>e.toggleTheme(),1:r(0),2:r(1),3:r(2),"?":Zs}}groups(){let{page:e}=this,t=e.connection?"reset vehicles and objects":"start of the level",r=[{keys:", .",action:"one row back, forward"},{keys:"← →",action:"one second back, forward (in the view: rotate it)"},{keys:"[ ]",action:"previous, next level"},{keys:"Home End",action:"start, end"}],i={Time:[{keys:"space",action:"play, pause"},...e.connection?[{keys:".",action:"one step"}]:r,{keys:"< >",action:"slower, faster"},...e.connection&&!e.connection.allowsReset?[]:[{keys:"r",action:t}]],View:[{keys:"o b v m",action:"orbit, behind the vehicle, next camera, map from above"},...e.pack.head.file_view?[{keys:"p",action:"the camera of the scene file"}]:[],{keys:"k",action:"orbit follows the vehicle, or stays"},{keys:"arrows, drag",action:"rotate; with Shift or the right button: move"},{keys:"+ -, wheel",action:"nearer, farther"},{keys:"h",action:"first view"},{keys:"x",action:"clear water, or the scene's fog"},{keys:"1 2 3",action:"clear sky, dusk, cloudy"}],Shown:[{keys:"c",action:"images of the cameras"},{keys:"z",action:"state of the vehicle; a click on a number draws its curve"},{keys:"f l",action:"frames, names"},{keys:"t y",action:"trails; restart them"},{keys:"s",action:"beams and fans of sonars"},{keys:"n",action:"light or dark colours"},{keys:"?",action:"these keys"}]};if(!e.connection)return i;let n=e.connection.pilot;for(let a of Object.values(i).flat())a.keys=a.keys.split(" ").map(o=>n.isReserved(o)?`Shift+${o}`:o).join(" ");return{...i,...e.connection.helpGroups()}}};function hc({water:s,view:e}){let t=s.media?.[0];return t?Math.min(...t.absorption.map((i,n)=>i+t.scattering[n]))*Math.hypot(...e.at.map((i,n)=>i-e.pose[n]))>3:!0}var bi=class{entries=[];clearMedium;constructor(e){let{media:t,clear:r}=e.head.water;for(let i of t??[])this.add(e,i);this.clearMedium=r?uc(e,r):null}add(e,t){this.entries.length>=64&&this.entries.splice(1,1),this.entries.push(uc(e,t))}mediumAt(e){if(!this.entries.length)return null;let t=e.signal("beam_attenuation"),r=t===void 0?this.entries[0]:jm(this.entries,t),i=e.signal("exposure_level");if(i===void 0)return r;let n=2**i/r.exposure;return{...r,exposure:2**i,clear_exposure:n*r.clear_exposure}}clearOptics(e){return e&&this.clearMedium&&{...this.clearMedium,exposure:e.clear_exposure}}};function jm(s,e){let t=s.map(({absorption:r,scattering:i})=>Math.abs(r[1]+i[1]-e));return s[t.lastIndexOf(Math.min(...t))]}function uc(s,e){let t=s.numbers(e.transform.values);return{...e,transform:{...e.transform,values:t}}}var dc=200,mc=5,ya=6e3,$m=1200,ba=180/Math.PI,wi=class{constructor(e,t){this.head=e;this.rays=t}head;rays;histories=new Map;readings=[];storeTime=-1/0;trial=-1;vehicle=0;setReadings(e){let t=JSON.stringify(e)!==JSON.stringify(this.readings);return this.readings=e,t}compute(e,t,r){this.vehicle=r;let i=this.readings.map(([n,a,o])=>({name:n,unit:a,value:o}));return[...this.motionQuantities(e,t),...i]}store(e,t){if(e<this.storeTime&&this.histories.clear(),!(e>=this.storeTime&&e<this.storeTime+1/mc)){this.storeTime=e;for(let{name:r,unit:i,value:n}of t){let a=this.historyOf(r,i);a.times.push(e),a.values.push(n),!(a.times.length<=ya)&&(a.times.splice(0,ya/2),a.values.splice(0,ya/2))}}}history({name:e,unit:t},r){if(r.isLive)return this.historyOf(e,t);r.trial!==this.trial&&this.histories.clear(),this.trial=r.trial;let i=this.histories.get(e);if(i)return i;let n=this.historyOf(e,t),a=r.end-r.start,o=Math.max(2,Math.min($m,Math.ceil(a*mc)));for(let l=0;l<o;++l){let c=r.start+a*l/(o-1),h=this.motionQuantities(r.snapshot(c),r,e);n.times.push(c),n.values.push(h.find(f=>f.name===e)?.value??null)}return n}historyOf(e,t){let r=this.histories.get(e);return r||this.histories.set(e,r={name:xi(e),unit:t,times:[],values:[]}),r}motionQuantities(e,t,r=""){let i=this.head.vehicles[this.vehicle];if(!i)return[];let n=pc(this.head,e,i.body),[a,o,l]=me(n),c=this.zAxisSign(i.body),h=Math.atan2(n[0],n[4])*ba,f=[{name:"depth",unit:"m",value:this.head.water.surface_height-l},{name:"heading",unit:"deg",value:Math.round(10*(h+360))/10%360},{name:"roll",unit:"deg",value:Math.atan2(c*n[9],c*n[10])*ba},{name:"pitch",unit:"deg",value:Math.asin(Math.max(-1,Math.min(1,n[8])))*ba},{name:"speed",unit:"m/s",value:t.speed(i.body,e.time)}];(!r||r==="altitude")&&f.splice(1,0,{name:"altitude",unit:"m",value:this.altitude([a,o,l],i.name,e)});let d=["x","y","z"].map(_=>e.signal(`water/${i.name}/${_}`)??0),p=Math.hypot(...d);return(p>=.005||r)&&f.push({name:"current",unit:"m/s",value:p}),f}zAxisSign(e){let t=this.head.bodies.find(({name:r})=>r===e);return t&&nt(t.pose)[10]<0?-1:1}altitude(e,t,r){let i=Me(e,[0,0,-dc]),n=o=>pc(this.head,r,o),a=this.rays.cast(e,i,n,o=>o.vehicle===t);return a<1?a*dc:null}};function pc(s,e,t){let r=s.bodies.find(({name:i})=>i===t);return e.poses.get(t)??nt(r?.pose??[0,0,0,1,0,0,0])}function xi(s){let[e,t]=[s.split("/")[0],s.slice(s.indexOf("/")+1)];return t===s||e==="joint"||t.toLowerCase().includes(e)?t:`${t} ${e}`}var vc=100,Km=["depth","speed"],Qm={deg:"°",1:"×"},Ei=class{constructor(e,t,r,i){this.quantities=e;this.player=t;this.redraw=i;this.curves=new ar(z("state"),r)}quantities;player;redraw;cells=new Map;selection=new Set;curves;hasSelection=!1;displayTime=0;isUpdatePending=!1;lastState=null;values=[];show(e,t,r){this.lastState=[e,t,r];let i=performance.now();i-this.displayTime>=vc||!this.player.isLive?(this.displayTime=i,this.values=this.quantities.compute(e,this.player,t),this.player.isLive&&this.quantities.store(e.time,this.values),this.values.forEach(o=>this.fill(o))):this.isUpdatePending||(this.isUpdatePending=!0,setTimeout(()=>{this.isUpdatePending=!1,this.show(...this.lastState)},vc)),z("hud").hidden=!r||!this.values.length,!this.hasSelection&&this.values.length&&this.selectInitial();let a=this.selectedCurves();z("state-box").hidden=!a.length,a.length&&this.curves.show(e.time,a)}redrawCurves(){this.curves.redraw()}selectInitial(){this.hasSelection=!0,this.player.isLive&&!this.player.curves.length&&!this.player.levels.length&&Km.forEach(e=>this.selection.add(e)),this.mark()}selectedCurves(){return this.values.filter(({name:t})=>this.selection.has(t)).map(t=>this.quantities.history(t,this.player))}fill({name:e,unit:t,value:r}){let i=this.cells.get(e)??this.cell(e);i.value.textContent=Jm(r,t)}cell(e){let t=$("button","",e.startsWith("joint/")?"joint":""),r=$("output");t.append($("span",xi(e)),r),t.title=`${xi(e)}: show or hide its curve`,t.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.hasSelection=!0,this.mark(),this.redraw()});let i={button:t,value:r};return this.cells.set(e,i),this.mark(),z("hud").append(t),i}mark(){for(let[e,{button:t}]of this.cells)t.setAttribute("aria-pressed",String(this.selection.has(e)))}};function Jm(s,e){if(s===null)return"–";let t={deg:1,m:2,"m/s":2,N:1,"%":0}[e]??2,r=s.toFixed(t).replace(/^-(0(\.0*)?)$/,"$1"),i=Qm[e]??` ${e}`;return`${r.replace("-","−")}${i}`}var Zm={orbit:["Orbit","Orbit around the vehicle (o)"],chase:["Chase","From behind the vehicle (b)"],camera:["Camera","Image of a camera (v)"],map:["Map","From above, north up (m)"],file:["File","From the <camera> of the scene file (p)"]},ep={clear:["Clear water","Water without fog (x)"],state:["State","Depth, heading, joints and more; a click on a number draws its curve (z)"],pictures:["Cameras","Images of the cameras (c)"],frames:["Frames","Coordinate frames with their names (f)"],trails:["Trails","Trails of bodies (t)"],sonars:["Sonars","Beams and fans (s)"]};function gc(s,e,t){for(let i of e){let[n,a]=Zm[i],o=$("button",n);o.title=a,o.dataset.mode=i,o.setAttribute("role","radio"),o.addEventListener("click",()=>s.show(i)),z("modes").append(o)}let r=z("camera");t.forEach((i,n)=>r.append(new Option(i,String(n)))),r.addEventListener("change",()=>{s.views.camera=Number(r.value),s.refresh()})}function _c(s){let{sensors:e,cameras:t,vehicles:r}=s.pack.head,i={sonars:e.length,pictures:t.length,state:r.length};for(let[n,[a,o]]of Object.entries(ep)){if(i[n]===0)continue;let l=$("button",a);l.dataset.switch=n,l.title=o,l.addEventListener("click",()=>s.toggle(n)),z("switches").append(l)}}function yc({views:s,switches:e,pack:t}){for(let i of z("modes").querySelectorAll("button"))i.setAttribute("aria-checked",String(i.dataset.mode===s.mode));for(let i of z("switches").querySelectorAll("button"))i.setAttribute("aria-pressed",String(e[i.dataset.switch]));let r=z("camera");r.hidden=s.mode!=="camera"||t.head.cameras.length<2,r.value=String(s.camera)}var bc=["orbit","chase","camera","map","file"],tp=.9,rp=.4,Ai=class{constructor(e,t,r){this.head=e;this.models=t;this.rays=r;this.orbit=wa(e.view),this.restoreInitial()}head;models;rays;mode="orbit";camera=0;version=0;vehicle=0;holdOffset=null;orbit;file=null;chaseAzimuth=0;height=12;mapOffset=[0,0];follow(e){e!==this.vehicle&&(this.vehicle=e,this.version+=1)}toggleFollowing(){this.holdOffset=this.holdOffset?null:this.displacement(),this.version+=1}restoreInitial(){this.version+=1,this.holdOffset=null,this.orbit=wa(this.head.view),this.file=this.head.file_view&&wa(this.head.file_view),this.chaseAzimuth=0,this.mapOffset.fill(0),this.height=Math.max(6,2*this.orbit.distance)}viewCamera(e,t){let{view:r,file_view:i}=this.head,n=Eo(e,t,(this.mode==="file"&&i?i:r).fovy),a=this.mode==="camera"?this.head.cameras[this.camera]:void 0;if(a){let l=Ea(a,e,t);return{worldFromCamera:this.models.worldFromMount(a),intrinsics:l,isExternal:!1,camera:a}}let o;if(this.mode==="map"){let[l,c]=Me(this.centre(),[...this.mapOffset,0]);o=In([l,c,this.centre()[2]+this.height],[l,c,this.centre()[2]],[0,1,0])}else if(this.mode==="chase"&&this.base()){let l=this.base(),c=Math.atan2(l[4],l[0])+Math.PI+this.chaseAzimuth;o=this.chasePose(c,Math.max(.15,this.orbit.elevation))}else if(this.mode==="file"&&this.file)o=Ls(this.file);else{let l=Me(this.orbit.target,this.holdOffset??this.displacement());o=Ls({...this.orbit,target:l})}return{worldFromCamera:o,intrinsics:n,isExternal:!0,camera:null}}drag(e,t,r){if(this.version+=1,this.mode==="map"||r)return this.move(e,t);this.mode==="chase"?this.chaseAzimuth-=4*e:this.activeView().azimuth-=4*e;let i=this.activeView();i.elevation=xa(i.elevation+3*t,-1.55,1.55)}zoom(e){this.version+=1,this.mode==="map"?this.height=xa(this.height*e,.5,2e3):this.activeView().distance=xa(this.activeView().distance*e,.1,2e3)}move(e,t){if(this.mode==="map"){let n=2*this.height*Math.tan(this.head.view.fovy/2);this.mapOffset[0]-=e*n,this.mapOffset[1]+=t*n;return}let r=this.activeView(),i=Ls(r);r.target=Me(r.target,[i[0],i[4],i[8]],-e*r.distance),r.target=Me(r.target,[i[1],i[5],i[9]],t*r.distance)}activeView(){return this.mode==="file"&&this.file?this.file:this.orbit}chasePose(e,t){let r=this.centre(),{distance:i}=this.orbit,n=Ls({target:r,azimuth:e,elevation:t,distance:i}),a=this.head.vehicles[this.vehicle].name,o=d=>this.models.body(d),l=.05*i,c=[[0,0],[l,0],[-l,0],[0,l],[0,-l]].map(([d,p])=>this.rays.cast(r,Re(n,[d,p,0]),o,_=>_.vehicle===a)),h=Math.min(...c);if(h>=1)return n;let f=Math.max(Math.min(rp,i),tp*h*i);return Ls({target:r,azimuth:e,elevation:t,distance:f})}base(){let e=this.head.vehicles[this.vehicle];return e?this.models.body(e.body):null}displacement(){let e=this.head.vehicles[this.vehicle],t=this.head.bodies.find(({name:r})=>r===e?.body);return t?Me(this.centre(),t.pose.slice(0,3),-1):[0,0,0]}centre(){let e=this.base();return e?Re(e,[0,0,0]):this.head.view.at}};function wa(s){let e=Me(me(nt(s.pose)),s.at,-1),t=Math.hypot(...e);return{target:[...s.at],azimuth:Math.atan2(e[1],e[0]),elevation:Math.asin(e[2]/t),distance:t}}function Ls({target:s,azimuth:e,elevation:t,distance:r}){let[i,n]=[Math.cos(t),Math.sin(t)],a=xt([i*Math.cos(e),i*Math.sin(e),n]);return In(Me(s,a,r),s)}function Ea(s,e,t){let r=Math.min(t/s.height,e/s.width);return{width:e,height:t,fx:s.fx*r,fy:s.fy*r,cx:(e-1)/2+(s.cx-(s.width-1)/2)*r,cy:(t-1)/2+(s.cy-(s.height-1)/2)*r,skew:s.skew*r,near:s.near,far:s.far}}function xa(s,e,t){return Math.min(t,Math.max(e,s))}var wc=[.1,.25,.5,1,2,5,10,20],Si=class{constructor(e,t,r,i,n,a){this.pack=e;this.player=t;this.picture=r;this.views=i;this.connection=n;this.rays=a;this.switches.clear=hc(e.head),this.quantities=new wi(e.head,a),this.hud=new Ei(this.quantities,t,o=>this.seek(o),()=>this.draw()),this.levels=new Qs(t,o=>{this.go(o)}),this.thrusters=new Js(e.head),this.keyboard=new yi(this),this.build(),requestAnimationFrame(o=>this.tick(o))}pack;player;picture;views;connection;rays;time=0;isPlaying=!1;speed=1;switches={clear:!0,pictures:!0,state:!0,frames:!1,labels:!1,trails:!0,sonars:!0,sun:""};curves=new ar(z("curves"),e=>this.seek(e));quantities;hud;levels;thrusters;keyboard;lastTick=performance.now();drawnKey="";note="";async go(e){let t=this.player.levels[e];!t||this.connection||(await this.select(t.trial),this.seek(t.level.start))}async select(e){if(e===this.player.trial)return;await this.player.select(e),this.picture.models.select(e),this.rays.trial=e,z("message").textContent=Fo(this.player)?"This trial has no recorded motion.":this.note,this.curves.set(this.player.curves);let{start:t,end:r}=this.player;this.levels.mark(t,r),Object.assign(z("time"),{min:String(t),max:String(r)})}seek(e){this.connection||(this.time=Math.min(this.player.end,Math.max(this.player.start,e)),this.draw())}play(e=!this.isPlaying){this.isPlaying=e,e&&!this.connection&&this.time>=this.player.end-1e-6&&(this.time=this.player.start),this.connection?.control(e?"play":"pause"),z("play").textContent=e?"Pause":"Play"}step(e){this.play(!1),this.connection?this.connection.control("step"):this.seek(this.time+e/30)}reset(){this.connection?this.connection.control("reset"):this.seek(this.player.levels[yr(this.player,this.time)]?.level.start??this.player.start)}setSpeed(e,t=!0){this.speed=e;let r=z("speed");[...r.options].some(({value:i})=>i===String(e))||r.append(xc(e)),r.value=String(e),t&&this.connection?.control("speed",e)}setState(e,t){this.isPlaying=!e,z("play").textContent=e?"Play":"Pause",this.setSpeed(t,!1)}changeSpeed(e){let t=n=>n||1/0,r=this.speeds().filter(n=>(t(n)-t(this.speed))*e>0),i=e>0?r[0]:r.at(-1);i!==void 0&&this.setSpeed(i)}speeds(){return this.connection?[...wc,0]:wc}show(e){this.modes().includes(e)&&(e==="camera"&&this.views.mode==="camera"&&(this.views.camera=(this.views.camera+1)%this.pack.head.cameras.length),this.views.mode=e,this.refresh())}modes(){let{cameras:e,file_view:t}=this.pack.head;return bc.filter(r=>(r!=="camera"||e.length)&&(r!=="file"||t))}toggle(e){this.switches[e]=!this.switches[e],e==="frames"&&(this.switches.labels=this.switches.frames),this.connection?.subscribe(this.switches.pictures),this.refresh()}clearTrails(){this.player.clearTrails(this.time),this.draw()}toggleTheme(){let e=document.documentElement;e.dataset.theme=e.dataset.theme==="dark"?"light":"dark",this.curves.redraw(),this.hud.redrawCurves(),this.connection?.topics.redrawCurves()}draw(){this.player.isLive&&(this.time=this.player.end);let e=this.player.snapshot(this.time);this.hud.show(e,this.views.vehicle,this.switches.state);let t=this.picture.draw(this.player,e,this.views,this.switches);t&&this.connection?.requestView(t),this.levels.show(this.time),this.curves.show(this.time,this.player.curves),z("curves-box").hidden=!this.player.curves.length,this.connection?.topics.show(this.time),this.thrusters.show(e);let r=[...document.querySelectorAll("aside > section")];document.body.classList.toggle("bare",r.every(({hidden:i})=>i)),z("time").value=String(this.time),z("clock").textContent=this.player.isLive?`${this.time.toFixed(2)} s`:`${this.time.toFixed(2)} / ${this.player.end.toFixed(2)} s`}tick(e){requestAnimationFrame(o=>this.tick(o));let t=Math.min(.25,(e-this.lastTick)/1e3);this.lastTick=e,this.isPlaying&&!this.connection&&(this.time=Math.min(this.player.end,this.time+t*this.speed),this.time>=this.player.end&&this.play(!1));let{clientWidth:r,clientHeight:i}=this.picture.canvas,a=[this.time,this.player.end,r,i,this.views.version,this.player.version].join()+JSON.stringify(this.switches);a!==this.drawnKey&&!document.hidden&&this.picture.isReady()&&(this.drawnKey=a,this.draw())}refresh(){yc(this),this.draw()}build(){gc(this,this.modes(),this.pack.head.cameras.map(({name:r})=>r)),_c(this);let e=z("speed");e.append(...this.speeds().map(xc)),e.addEventListener("change",()=>this.setSpeed(Number(e.value))),this.setSpeed(1,!1);let t=z("time");t.addEventListener("input",()=>this.seek(Number(t.value))),z("play").addEventListener("click",()=>this.play()),z("step").addEventListener("click",()=>this.step(1)),z("back").addEventListener("click",()=>this.step(-1)),z("back").hidden=z("line").hidden=this.player.isLive,z("help-button").addEventListener("click",Zs),this.refresh()}};function xc(s){return new Option(s?`${s}×`:"fastest",String(s))}var Mi=class{constructor(e,t){this.pack=e;this.head=t}pack;head;trial=-1;current=null;surfaceAt(e,t){let{surface:r,trials:i}=this.head;if(!r)return null;if(!this.current||e!==this.trial){let n=i?.[e]?.surface??r;this.trial=e,this.current={waves:Ti(this.pack,n.waves),ripples:Ti(this.pack,n.ripples)}}return{...this.current,time:t.time,scale:t.signal("wave_scale")??r.scale}}};function Ti(s,e){if(!e)return null;let t=s.numbers(e),r=t.length/5,[i,n,a,o,l]=[0,1,2,3,4].map(c=>t.subarray(r*c,r*(c+1)));return{amplitude:i,omega:n,kx:a,ky:o,phase:l}}var sp=9.81,ip=2*Math.PI/65536,Ri=class{constructor(e,t){this.pack=e;this.head=t}pack;head;trial=-1;ripples=null;waves=null;tile=null;scale=NaN;surfaceAt(e,t){let{caustics:r,trials:i}=this.head;if(!r)return null;if(!this.ripples||e!==this.trial){let{phases:a,waves:o}=i?.[e]?.caustics??r;this.trial=e,this.ripples=np(this.pack,r,this.pack.numbers(a)),this.waves=Ti(this.pack,o),this.tile=null}let n=t.signal("wave_scale")??r.scale;return(!this.tile||n!==this.scale)&&(this.tile=this.waves?op(this.ripples,ap(r,this.waves,n)):this.ripples,this.scale=n),{time:t.time,scale:n,tile:this.tile,waves:this.waves}}};function np(s,e,t){let[r,i]=[e.columns,e.rows].map(a=>s.numbers(a)),n=2*Math.PI/e.edge;return{columns:r,rows:i,amplitude:Float64Array.from(s.numbers(e.amplitudes),a=>e.amplitude*a),omega:Float64Array.from(r,(a,o)=>{let l=n*Math.hypot(a,i[o]);return Math.sqrt(sp*l+e.tension*l**3)}),phase:Float64Array.from(t,a=>ip*a)}}function ap({edge:s,wave_lengths:e},t,r){let i=2*Math.PI/s,n=Array.from(t.kx,(c,h)=>2*Math.PI/Math.hypot(c,t.ky[h])),a=[...n.keys()].filter(c=>n[c]<e[1]&&n[c]>=e[0]),o=Int16Array.from(a,c=>Ec(t.kx[c]/i)),l=Int16Array.from(a,c=>Ec(t.ky[c]/i));return{columns:o,rows:l,amplitude:Float64Array.from(a,(c,h)=>r*t.amplitude[c]*2*Math.PI/n[c]/(i*Math.hypot(o[h],l[h]))),omega:Float64Array.from(a,c=>t.omega[c]),phase:Float64Array.from(a,c=>t.phase[c])}}function Ec(s){return Math.abs(s%1)===.5?2*Math.round(s/2):Math.round(s)}function op(s,e){let t=r=>Float64Array.from([...s[r],...e[r]]);return{columns:Int16Array.from([...s.columns,...e.columns]),rows:Int16Array.from([...s.rows,...e.rows]),amplitude:t("amplitude"),omega:t("omega"),phase:t("phase")}}function Ac({columns:s,rows:e,amplitude:t,omega:r,phase:i},n,a,o,l){let{reals:c,imaginaries:h}=l;c.fill(0),h.fill(0);let f=a-1;for(let d=0;d<s.length;++d){let[p,_]=[s[d],e[d]],y=t[d]*Math.PI/n,w=i[d]-r[d]*o,E=y*Math.cos(w),x=y*Math.sin(w),M=(_&f)*a+(p&f),S=(-_&f)*a+(-p&f);c[M]+=-p*x-_*E,h[M]+=p*E-_*x,c[S]+=-p*x+_*E,h[S]+=-p*E-_*x}}var Li=class{constructor(e,t){this.heap=e;this.positions=t;this.initialHeights=Float32Array.from({length:t.length/3},(r,i)=>t[3*i+2]-e.corner[2]),this.heights=this.initialHeights.slice()}heap;positions;heights;initialHeights;removals=[];lastHeights=null;set(e){return e===this.lastHeights?!1:(this.lastHeights=e,this.heights.set(e.subarray(0,this.heights.length)),!0)}apply(e){let t=this.removals,r=e.length>=t.length&&t.every((i,n)=>i===e[n]);if(r&&e.length===t.length)return!1;r||this.heights.set(this.initialHeights);for(let{position:i}of r?e.slice(t.length):e)i?this.remove(i):this.heights.set(this.initialHeights);return this.removals=e,!0}surface(){let{heap:e,heights:t}=this,[r,i]=e.columns,n=Float32Array.from(this.positions),a=new Int16Array(n.length),o=(l,c,h)=>{let[f,d]=[Math.max(0,l-1),Math.min(c-1,l+1)];return(h(d)-h(f))/((d-f)*e.cell)};for(let l=0;l<r;++l)for(let c=0;c<i;++c){let h=l*i+c,f=o(l,r,_=>t[_*i+c]),d=o(c,i,_=>t[l*i+_]),p=32767/Math.hypot(f,d,1);n[3*h+2]=e.corner[2]+t[h],a.set([-f*p,-d*p,p],3*h)}return{positions:n,normals:a}}remove([e,t,r]){let{heap:i,heights:n}=this,[a,o]=i.columns,l=i.reach**2,c=(_,y)=>[Math.max(0,Math.floor((_-i.reach)/i.cell)),Math.min(y-1,Math.ceil((_+i.reach)/i.cell))],[[h,f],[d,p]]=[c(e,a),c(t,o)];for(let _=h;_<=f;++_)for(let y=d;y<=p;++y){let w=_*o+y;(_*i.cell-e)**2+(y*i.cell-t)**2+(n[w]-r)**2<l&&(n[w]=Math.max(0,n[w]-i.bite))}}};var Sc=`// Provides: pixels without a surface: the water's far colour, range inf, id 0.
// Needs: frame.glsl, grey.glsl, targets.glsl.
// The far colour is the limit of the water's image model at infinite distance.
#include "frame.glsl"
#include "grey.glsl"
#ifdef PHYSICAL
#include "optics.glsl"
#endif
#include "targets.glsl"

void main() {
#ifdef COLOUR
#ifdef PHYSICAL
    colour_out = vec4(0.0, 0.0, 0.0, FAR);
#else
    colour_out = vec4(camera_colour(background.rgb), 1.0);
#endif
#endif
#ifdef RANGE
    range_out = uintBitsToFloat(0x7f800000u);
#endif
#ifdef IDS
    id_out = 0u;
#endif
}
`;var Mc=`// Provides: one triangle over the whole image at the far plane.
// Needs: nothing; three vertices without attributes.
// Depth 1 passes only where nothing has been drawn.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
}
`;var Tc=`// Provides: weight(row, range), a share of the light of surfaces: row 0 is sharp light, row 1 + level that of a level of blur.
// Needs: the table of physical/blur_weights.py; VARYING is \`out\` in the vertex shader, which needs optics.glsl and calls pass_on_table();
// it is \`in\` in the fragment shader, with READS_VARYINGS. One linear look-up; a range r has the place r / (r + L).
uniform sampler2D weight_table;
flat VARYING vec4 v_table;  // x: L [m]; y, z: factor and offset from places to columns, 0..1; w: height of a row
#ifdef READS_VARYINGS
vec3 weight(int row, float range) {
    float place = range / (range + v_table.x);
    return texture(weight_table, vec2(place * v_table.y + v_table.z, (float(row) + 0.5) * v_table.w)).rgb;
}
#else
void pass_on_table() {
    vec2 size = vec2(textureSize(weight_table, 0));
    v_table = vec4(camera.z, (size.x - 1.0) / size.x, 0.5 / size.x, 1.0 / size.y);
}
#endif
`;var Rc=`// Provides: the Gaussian of a level of blur along its columns, plus the wider levels; at the first level, plus the lamps' veil.
// Needs: gaussian.glsl; the level after its rows, or before them with SQUARE; with WIDER, the sum of the wider levels at half the
// resolution; with LAMPS, the number of lamps: veil_varyings.glsl, lamp_veil.glsl, and the mean light, whose alpha is the range. With
// VEIL_ONLY there is no level. blurred.vert.glsl has the varyings.
#include "gaussian.glsl"
uniform sampler2D level_0;
#ifdef WIDER
uniform sampler2D level_1;
noperspective in vec2 v_wider_place;
#endif
#ifdef LAMPS
#define VARYING in
#define READS_VARYINGS
#include "veil_varyings.glsl"
#include "lamp_veil.glsl"
uniform sampler2D level_2;
noperspective in vec2 v_ray;
#endif
out vec4 light_out;

void main() {
#ifdef VEIL_ONLY
    vec3 sum = vec3(0.0);
#elif defined(SQUARE)
    vec3 sum = square_gaussian(level_0).rgb;
#else
    vec3 sum = gaussian(level_0, ivec2(0, 1)).rgb;
#endif
#ifdef WIDER
    sum += texture(level_1, v_wider_place).rgb;
#endif
#ifdef LAMPS
    float range = texelFetch(level_2, ivec2(gl_FragCoord.xy), 0).a;
    vec3 ray = normalize(vec3(v_ray, -1.0));
    for (int i = 0; i < LAMPS; ++i) sum += lamp_veil(i, ray, range);
#endif
    light_out = vec4(sum, 1.0);
}
`;var Lc=`// Provides: the Gaussian of a level of blur along its rows.
// Needs: gaussian.glsl; the texture of the level.
// blurred.frag.glsl adds that along the columns.
#include "gaussian.glsl"
uniform sampler2D level_0;
out vec4 light_out;

void main() {
    light_out = gaussian(level_0, ivec2(1, 0));
}
`;var Pc=`// Provides: one triangle over the whole target, with the place of each texel in the wider levels, and the numbers of the lamps.
// Needs: the textures and the switches of blurred.frag.glsl; with LAMPS: optics.glsl, lamps.glsl, veil_varyings.glsl.
// Rays of the first level, which has half the resolution, are linear over the image.
#ifdef LAMPS
#define VARYING out
#include "optics.glsl"
#include "lamps.glsl"
#include "veil_varyings.glsl"
uniform sampler2D level_2;
noperspective out vec2 v_ray;  // slopes of the ray, camera frame
#endif
#ifdef WIDER
uniform sampler2D level_0;
uniform sampler2D level_1;
noperspective out vec2 v_wider_place;
#endif

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
#ifdef WIDER
    v_wider_place = (0.25 * corner + 0.25) * vec2(textureSize(level_0, 0)) / vec2(textureSize(level_1, 0));
#endif
#ifdef LAMPS
    vec2 pixel = (corner + 1.0) * vec2(textureSize(level_2, 0));
    v_ray = ray_first.xy + pixel.x * ray_column.xy + pixel.y * ray_row.xy;
    pass_on_lamps();
#endif
}
`;var Ic=`// Provides: caustic_excess(place, depth, depths, swell_frame), the gain of the sun's beam by the moving surface, minus 1.
// Needs: the maps of caustics/caustic_map.py; with SWELL the grid of caustics/swell.py; place: where the beam enters, in tiles.
// The light of one depth is interpolated between two maps. Above the first it is linear, and far below the last contrast falls.
uniform sampler2DArray caustic_maps;
#ifdef SWELL
uniform sampler2D swell_map;
#endif

#ifdef MAP_LEVEL
#define READ_MAP(place, index) textureLod(caustic_maps, vec3(place, index), map_level)
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame, float map_level) {
#else
#define READ_MAP(place, index) texture(caustic_maps, vec3(place, index))
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame) {
#endif
    float z = max(depth, 0.0);
    float density = 1.0;
#ifdef SWELL
    vec4 swell = textureLod(swell_map, place * frame.z + frame.xy, 0.0);
    vec2 inside = step(abs(place * frame.z + frame.xy - 0.5), vec2(0.5));
    density = 1.0 - z * (swell.z - z * swell.w) * inside.x * inside.y;
    place -= z * frame.w * swell.xy;
#endif
    float level = clamp(log2(max(z, depths.x)) * depths.y + depths.z, 0.0, float(N_SLICES - 1));
#if N_SLICES > 4
    float layer = step(0.5 * float(N_SLICES), level);  // of the maps 0 to 3, or 2 to 5
#else
    const float layer = 0.0;
#endif
    vec4 shares = max(1.0 - abs(vec4(0.0, 1.0, 2.0, 3.0) + 2.0 * layer - level), 0.0);
    float excess = dot(READ_MAP(place, layer), shares);
    float far = depths.w / max(z, depths.w);
    return (1.0 + excess * min(z / depths.x, 1.0) * far * far) * density - 1.0;
}
`;var kc=`// Provides: the block Caustics, the numbers of caustics that are constant in an image.
// Needs: nothing. Filled by caustics/caustic_light.py, where the same members are declared.
// A tile is the unit of length of maps.
layout(std140) uniform Caustics {
    vec4 caustic_x;       // place where the beam to a point in the camera frame enters: x of W = xyz * point + w [tiles]
    vec4 caustic_y;       // the same for y of W
    vec4 swell_frame;     // xy, z: coordinates in the grid of long waves = z * place + xy; w: tiles in a metre
    vec4 caustic_depths;  // x: first depth [m]; y, z: index of a map = y log2(depth) + z; w: last depth [m]
    vec4 caustic_loss;    // rgb: rate at which the contrast falls with depth [1/m]; w: greatest b p / (b* p*) in shafts on the way to the surface
    vec4 shaft_numbers;   // x: asymmetry of p*; y: b* / b; z: longest way [m]; w: texels in a tile
};
`;var Fc=`// Provides: daylight(facing, up_cosine, share, depth), the light of sun and sky under water; albedo_of(stored), a surface's albedo.
// Needs: varyings.glsl with PHYSICAL; facing = N.L; up_cosine = N.up; share = 0 in the sun's shadow to 1; depth below the surface [m].
// physical/daylight_field.py, physical/transfer_curve.py: the sun's beam, with CAUSTICS focused by waves; diffuse light from above, light from below.
// With CAUSTICS, call focus_beam(depth) before; with HULLS, sky_arrival is the share of diffuse light from above that arrives.
#ifdef CAUSTICS
#include "caustics.glsl"
vec3 beam_gain;
void focus_beam(float depth) {
    float excess = caustic_excess(v_caustic_place, depth, v_caustic_depths, v_swell_frame);
    beam_gain = 1.0 + exp(v_caustic_loss * -max(depth, 0.0)) * excess;
}
#endif
#ifdef HULLS
float sky_arrival = 1.0;
#else
const float sky_arrival = 1.0;
#endif
vec3 daylight(float facing, float up_cosine, float share, float depth) {
    float z = max(depth, 0.0);
    vec3 total = v_daylight_total * exp(v_daylight_loss * -z);
    vec3 level = min(v_sun_beam.rgb * exp(v_sun_loss * -z), total);
    vec3 diffuse = total - level;
#ifdef CAUSTICS
    level *= beam_gain;
#endif
    return level * (max(facing, 0.0) * share / v_sun_beam.w)
        + diffuse * ((0.5 + 0.5 * up_cosine) * sky_arrival) + v_upwelling * total * (0.5 - 0.5 * up_cosine);
}

vec3 albedo_of(vec3 stored) {
    vec3 root = sqrt(stored);
    return stored * (0.0982065878 + root * (-0.2653148210 + root * (0.7011382242 + root * (0.5186992531 - 0.0527292441 * root))));
}
`;var Cc=`// Provides: the optical depth of a lump of a cloud up to four ranges, and its light; the renderer adds them up.
// Needs: frame.glsl, optics.glsl, clouds.glsl, open_water.glsl; lamps.glsl with LAMPS; the outputs of cloud.vert.glsl.
// Closed form of a Gaussian along a ray: particles/puffs.py; the light: physical/cloud_pass.py.
#include "frame.glsl"
#include "optics.glsl"
#include "clouds.glsl"
#include "cloud_edge.glsl"
#include "open_water.glsl"
#ifdef LAMPS
#include "lamps.glsl"
#endif
uniform sampler2D surface_image;
flat in vec4 v_place;
flat in float v_depth;
layout(location = 0) out vec4 layers_out;    // optical depth up to each layer
layout(location = 1) out vec4 lamplight_out; // rgb: optical depth times lamplight scattered once; a: optical depth
layout(location = 2) out vec4 daylight_out;  // rgb: optical depth times excess of daylight over open water

vec4 error_function(vec4 x) {  // Abramowitz and Stegun 7.1.27, to 5e-4
    vec4 t = abs(x);
    vec4 root = 1.0 + t * (0.278393 + t * (0.230389 + t * (0.000972 + t * 0.078108)));
    root *= root;
    return sign(x) * (1.0 - 1.0 / (root * root));
}

#ifdef LAMPS
float phase(float cosine) {
    float q = sqrt(sqrt(clamp(0.5 - 0.5 * cosine, 0.0, 1.0)));
    float sum = phase_high.w;
    sum = sum * q + phase_high.z;
    sum = sum * q + phase_high.y;
    sum = sum * q + phase_high.x;
    sum = sum * q + phase_low.w;
    sum = sum * q + phase_low.z;
    sum = sum * q + phase_low.y;
    return exp(sum * q + phase_low.x);
}
#endif

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    vec2 pixel = float(CLOUD_EDGE) * gl_FragCoord.xy;
    vec3 ray = normalize(ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz);
    float foot = dot(ray, v_place.xyz);
    vec3 offset = v_place.xyz - foot * ray;
    float inverse = 0.70710678 / v_place.w;
    float peak = 0.5 * v_depth * exp(-dot(offset, offset) * inverse * inverse);
    if (peak < 1e-5) discard;
    vec4 ranges = cloud_layers.x + cloud_layers.y * vec4(0.0, 1.0, 2.0, 3.0);
    float begin = error_function(vec4(-foot * inverse)).x;
    vec4 depths = peak * max(error_function((ranges - foot) * inverse) - begin, 0.0);
    float total = peak * max(1.0 - begin, 0.0);
    float middle = max(foot, 0.5 * v_place.w);
    vec3 point = middle * ray;
    vec3 loss = absorption.rgb + 0.03 * scattering.rgb;  // c - 0.97 b, as in lamp_veil.glsl
    vec3 kept = exp(loss * -middle);
    float z = max(-(dot(point, up.xyz) + up.w), 0.0);
    vec3 day = cloud_colour.rgb * daylight_total.rgb * exp(daylight_loss.rgb * -z);
    vec3 sum = vec3(0.0);
#ifdef LAMPS
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - point;
        float distance = max(length(towards), max(0.5 * v_place.w, 0.1));
        vec3 direction = towards / distance;
        float cone = lamp_position[i].w > -1.0
            ? clamp((dot(lamp_axis[i].xyz, direction) - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0;
        float part = 3.14159265 * phase(dot(direction, ray)) * cone * cone * (3.0 - 2.0 * cone) / (distance * distance);
        sum += lamp_light[i].rgb * exp(loss * -distance) * part;
    }
    sum *= cloud_colour.rgb / max(max(cloud_colour.r, cloud_colour.g), max(cloud_colour.b, 1e-3));
#endif
    layers_out = depths;
    lamplight_out = vec4(total * kept * sum, total);
    daylight_out = vec4(total * kept * (day - open_water(pixel, size)), 0.0);
}
`;var Oc=`// Provides: the rectangle around a lump of a cloud of sediment.
// Needs: frame.glsl, optics.glsl; four vertices for each instance: its centre, width, and optical depth through its centre.
// Three widths around the centre; the whole image if the camera is inside.
#include "optics.glsl"
#include "cloud_edge.glsl"
uniform sampler2D surface_image;
in vec4 place;   // xyz: centre, camera frame [m]; w: width sigma [m]
in float depth;  // optical depth along a whole ray through the centre
flat out vec4 v_place;
flat out float v_depth;

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    v_place = place;
    v_depth = depth;
    float ahead = -place.z;
    float reach_of_lump = 3.0 * place.w;
    vec2 corner = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
    if (ahead < -reach_of_lump) {
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    } else if (ahead < 1.5 * reach_of_lump) {
        gl_Position = vec4(corner, 0.0, 1.0);
    } else {
        vec2 slope = place.xy / ahead - ray_first.xy;
        float row = slope.y / ray_row.y;
        vec2 pixel = vec2((slope.x - row * ray_row.x) / ray_column.x, row);
        float focal = inversesqrt(abs(ray_column.x * ray_row.y));
        float stretch = 1.0 + length(place.xy) / ahead;  // off the axis the outline is longer
        float radius = stretch * focal * reach_of_lump / sqrt(ahead * ahead - reach_of_lump * reach_of_lump);
        gl_Position = vec4(2.0 * (pixel + radius * corner) / size - 1.0, 0.0, 1.0);
    }
}
`;var Nc=`// Provides: CLOUD_EDGE, the edge of a texel of the textures of clouds [px].
// Needs: nothing. physical/cloud_pass.py has the same number.
// Clouds are smooth, and their layers keep them apart from surfaces.
#define CLOUD_EDGE 8
`;var Dc=`// Provides: the block Clouds: the ranges of the layers in which clouds of sediment are stored; LOSS_SHARE.
// Needs: nothing. Filled by physical/cloud_pass.py, where the same members are declared.
// A thick cloud in the light of a lamp is as bright as one of the optical depth 1 / LOSS_SHARE whose light is scattered once.
#define LOSS_SHARE 0.1
layout(std140) uniform Clouds {
    vec4 cloud_layers;  // x: first range [m]; y: step from layer to layer [m]
    vec4 cloud_colour;  // rgb: albedo of a thick cloud in daylight
};
`;var Vc=`// Provides: the stored colours of an image through physical water: direct light, blur, veil, exposure, curve.
// Needs: blur_weight.glsl with BLUR, else optics.glsl and transmission.glsl; open_water.glsl, grey.glsl, developed.vert.glsl; the image of
// the surfaces; with SCATTERED, the sum of the levels; with PARTICLES, the image of the particles; with SHAFTS, the edge of a texel [px],
// that of the shafts; the switches DRY for an image without water before the surfaces, LINEAR for no curve, LIGHT for no exposure either.
// B + D (J - B) + blur + veil: physical/development.py; the curve: physical/transfer_curve.py.
#define VARYING in
#define READS_VARYINGS
#include "optics.glsl"
#include "open_water.glsl"
#include "grey.glsl"
#ifdef BLUR
#include "blur_weight.glsl"
#else
#include "transmission.glsl"
#endif
uniform sampler2D surface_image;
flat in float v_exposure;
noperspective in vec2 v_water_place;
#ifdef SCATTERED
noperspective in vec2 v_level_place;
uniform sampler2D level_0;
#endif
#ifdef PARTICLES
uniform sampler2D particle_image;
#endif
#ifdef SHAFTS
noperspective in vec2 v_shaft_place;
uniform sampler2D shaft_image;
#endif
#ifdef CLOUDS
#include "clouds.glsl"
#include "cloud_edge.glsl"
uniform sampler2D cloud_layers_map;
uniform sampler2D cloud_lamplight_map;
uniform sampler2D cloud_daylight_map;

vec3 through_clouds(vec3 light, vec3 water, float range) {
    vec2 place = gl_FragCoord.xy / (float(CLOUD_EDGE) * vec2(textureSize(cloud_layers_map, 0)));
    vec4 layers = textureLod(cloud_layers_map, place, 0.0);
    vec4 lamplight = textureLod(cloud_lamplight_map, place, 0.0);
    vec3 daylight = textureLod(cloud_daylight_map, place, 0.0).rgb;
    vec4 shares = clamp((range - cloud_layers.x) / cloud_layers.y - vec4(0.0, 0.0, 1.0, 2.0), 0.0, 1.0);
    float depth = layers.x + dot(shares.yzw, layers.yzw - layers.xyz);
    vec3 mean = 1.0 / max(vec3(lamplight.a), 1e-6);
    vec3 veil = mean * lamplight.rgb * ((1.0 - exp(-LOSS_SHARE * depth)) / LOSS_SHARE);
    return mix(water + mean * daylight, light, exp(-depth)) + veil;
}
#endif
out vec4 colour_out;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 texel = texelFetch(surface_image, pixel, 0);
#ifdef DRY
    vec3 light = texel.rgb;
#else
    vec3 water = texture(open_water_map, v_water_place).rgb;
    vec3 light = water;
#ifdef PARTICLES
    vec4 particles = texelFetch(particle_image, pixel, 0);
    float seen = 1.0 - min(particles.a, 1.0);
#else
    const float seen = 1.0;
#endif
#ifdef SHAFTS
    light += seen * texture(shaft_image, v_shaft_place).rgb;
#endif
    float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
    float range = texel.a * is_surface;
    vec3 excess = (texel.rgb - water) * is_surface;
#ifdef BLUR
    vec3 sharp = weight(0, range);
#else
    vec3 sharp = whole_field(range);
#endif
#ifdef PARTICLES
    excess *= seen;
    light += particles.rgb;
#endif
    light += sharp * excess;
#ifdef SCATTERED
    vec3 scattered = texture(level_0, v_level_place).rgb;
#ifdef PARTICLES
    // what dark surfaces take from the water is behind the particles; the veil is mostly in front of them
    scattered = max(scattered, 0.0) + seen * min(scattered, 0.0);
#endif
    light += scattered;
#endif
#ifdef CLOUDS
    light = through_clouds(light, water, is_surface > 0.5 ? range : FAR);
#endif
#endif
#ifdef LIGHT
    colour_out = vec4(light, 1.0);
#else
    vec3 value = clamp(light * v_exposure, 0.0, 1.0);
#ifndef LINEAR
    vec3 second = sqrt(value);
    vec3 fourth = sqrt(second);
    vec3 curve = 0.642363 * second + 0.71211342 * fourth - 0.33687116 * sqrt(fourth) - 0.01756212 * value;
    value = mix(12.92 * value, curve, step(0.0031308, value));
#endif
    colour_out = vec4(camera_colour(value), 1.0);
#endif
}
`;var Uc=`// Provides: one triangle over the whole image, with the place of each pixel in coarser textures, and constants of the pass.
// Needs: optics.glsl, open_water.glsl; with BLUR, blur_weight.glsl; the textures and the switches of developed.frag.glsl.
// llvmpipe reads flat varyings much faster than uniforms in each pixel.
#define VARYING out
#include "optics.glsl"
#include "open_water.glsl"
#ifdef BLUR
#include "blur_weight.glsl"
#endif
uniform sampler2D surface_image;
flat out float v_exposure;
noperspective out vec2 v_water_place;
#ifdef SCATTERED
noperspective out vec2 v_level_place;
uniform sampler2D level_0;
#endif
#ifdef SHAFTS
noperspective out vec2 v_shaft_place;
uniform sampler2D shaft_image;
#endif

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    vec2 share = 0.5 * corner + 0.5;
    v_exposure = camera.y;
    v_water_place = open_water_place(share);
#ifdef BLUR
    pass_on_table();
#endif
#ifdef SCATTERED
    v_level_place = share * vec2(textureSize(surface_image, 0)) / (2.0 * vec2(textureSize(level_0, 0)));
#endif
#ifdef SHAFTS
    v_shaft_place = share * vec2(textureSize(surface_image, 0)) / (float(SHAFTS) * vec2(textureSize(shaft_image, 0)));
#endif
}
`;var Gc=`// Provides: the block Frame: values that are constant in an image.
// Needs: nothing. Filled by frame.py, where the same members are declared.
// Camera frame: OpenGL axes (x right, y up, -z ahead), metres.
layout(std140) uniform Frame {
    mat4 clip_from_camera;
    mat4 shadow_from_camera;  // to texture coordinates and depth, 0..1
    vec4 up;                  // xyz: W's z axis, camera frame; w: camera's height above the water [m]
    vec4 sun;                 // xyz: towards the sun, camera frame; w: offset along normals against self-shadowing [m]
    vec4 sunlight;            // rgb: colour of the sun times the light rate
    vec4 ambient_specular;    // x: ambient, y: specular brightness, both times the light rate
    vec4 water_colour;        // rgb: colour of in-scattered light
    vec4 attenuation;         // rgb [1/m]
    vec4 fog;                 // rgb: colour; w: density squared [1/m2]
    vec4 clip_fog;            // clip-space z, the distance in UWSim's fog = x * planar depth + y [m]
    vec4 background;          // rgb: colour of pixels without a surface
};
`;var zc=`// Provides: gaussian(level, step), the Gaussian of a level at this texel along step, (1, 0) or (0, 1); with SQUARE, square_gaussian(level).
// Needs: the switches RADIUS [texels] and SPREAD, a thousand times the standard deviation [texels].
// Outside the level its edge is continued.
vec4 gaussian(sampler2D level, ivec2 step_) {
    ivec2 last = textureSize(level, 0) - 1;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(level, texel, 0);
#if RADIUS > 0
    const float rate = 500000.0 / (float(SPREAD) * float(SPREAD));
    float total = 1.0;
    for (int i = 1; i <= RADIUS; ++i) {
        float weight = exp(-rate * float(i * i));
        sum += weight * (texelFetch(level, clamp(texel - i * step_, ivec2(0), last), 0)
            + texelFetch(level, clamp(texel + i * step_, ivec2(0), last), 0));
        total += 2.0 * weight;
    }
    sum /= total;
#endif
    return sum;
}

#ifdef SQUARE
// The Gaussian along rows and columns in one pass, for small levels.
vec4 square_gaussian(sampler2D level) {
    ivec2 last = textureSize(level, 0) - 1;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    const float rate = 500000.0 / (float(SPREAD) * float(SPREAD));
    vec4 sum = vec4(0.0);
    float total = 0.0;
    for (int i = -RADIUS; i <= RADIUS; ++i) {
        float row_weight = exp(-rate * float(i * i));
        total += row_weight;
        for (int j = -RADIUS; j <= RADIUS; ++j)
            sum += row_weight * exp(-rate * float(j * j)) * texelFetch(level, clamp(texel + ivec2(j, i), ivec2(0), last), 0);
    }
    return sum / (total * total);
}
#endif
`;var Bc=`// Provides: camera_colour(colour), the colour of a pixel in the image of a colour or grey camera.
// Needs: nothing.
// With the switch GREY: int(0.2989 R) + int(0.5870 G) + int(0.1140 B) of 8-bit values, as in grey.py. Only the viewer's page sets it.
vec3 camera_colour(vec3 colour) {
#ifdef GREY
    vec3 stored = floor(clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
    vec3 terms = floor(stored * vec3(0.2989, 0.5870, 0.1140) + 5e-5);
    return vec3((terms.r + terms.g + terms.b) / 255.0);
#else
    return colour;
#endif
}
`;var Wc=`// Provides: the block Instance: the pose of one instance in the camera frame, and its id.
// Needs: nothing. Filled by instance.py, where the same members are declared.
// camera_normals is the inverse transpose of camera_from_model (scale may be uneven).
layout(std140) uniform Instance {
    mat4 camera_from_model;
    mat4 camera_normals;
    uvec4 identity;  // x: id, 1..65535
};
`;var Hc=`// Provides: the radiance of a lamp that the camera sees, and its range.
// Needs: optics.glsl, targets.glsl with COLOUR; the outputs of lamp_point.vert.glsl. The renderer adds radiance and replaces range.
// pi I lobe / (d^2 Omega) with the solid angle Omega of a pixel, divided among the four pixels around the lamp.
#include "optics.glsl"
#include "targets.glsl"
flat in vec3 v_position;
flat in vec3 v_axis;
flat in vec4 v_light;
flat in float v_steepness;

void main() {
    float range = max(length(v_position), 0.01);
    float cosine = dot(v_axis, v_position) / range;
    float share = v_light.w > -1.0 ? clamp((cosine - v_light.w) * v_steepness, 0.0, 1.0) : 1.0;
    vec2 slope = v_position.xy / -v_position.z - ray_first.xy;
    float row = slope.y / ray_row.y;
    float column = (slope.x - row * ray_row.x) / ray_column.x;
    vec2 weight = max(1.0 - abs(gl_FragCoord.xy - vec2(column, row)), 0.0);
    float part = weight.x * weight.y * share * share * (3.0 - 2.0 * share);
    if (part <= 0.0) discard;
    float axis_cosine = -v_position.z / range;
    float solid_angle = axis_cosine * axis_cosine * axis_cosine * abs(ray_column.x * ray_row.y);
    colour_out = vec4(v_light.rgb * (3.14159265 * part / (range * range * solid_angle)), range);
}
`;var Yc=`// Provides: a point of 3 x 3 pixels where the camera sees a lamp.
// Needs: frame.glsl, lamps.glsl with LAMPS; a vertex for each lamp, without attributes.
// The depth is that of a point 0.1 m nearer, so that a lamp's own housing does not hide it.
#include "frame.glsl"
#include "lamps.glsl"
flat out vec3 v_position;  // of the lamp, camera frame [m]
flat out vec3 v_axis;
flat out vec4 v_light;     // rgb: intensity times colour; w: cosine at the edge of the cone
flat out float v_steepness;

void main() {
    int i = gl_VertexID;
    v_position = lamp_position[i].xyz;
    v_axis = lamp_axis[i].xyz;
    v_light = vec4(lamp_light[i].rgb, lamp_position[i].w);
    v_steepness = lamp_axis[i].w;
    gl_Position = clip_from_camera * vec4(v_position, 1.0);
    float range = max(length(v_position), 1e-3);
    vec4 nearer = clip_from_camera * vec4(v_position * max(1.0 - 0.1 / range, 0.5), 1.0);
    if (gl_Position.w > 0.0 && nearer.w > 0.0) gl_Position.z = nearer.z / nearer.w * gl_Position.w;
    gl_PointSize = 3.0;
}
`;var qc=`// Provides: lamp_veil(i, ray, range), the light of a lamp that the water scatters into the camera along a unit ray.
// Needs: veil_varyings.glsl. optics/lamp_light.py has the formulas; no shadows.
// With u = tan(pi/4 + eta/2): cos(eta) = 2u / (1 + u^2), sin(eta) = (u^2 - 1) / (1 + u^2), t + d = t0 + h u.
// tan up to 45 degrees, within 3e-4 of it.
float tan_of(float angle) {
    float square = angle * angle;
    return angle * (15.0 - square) / (15.0 - 6.0 * square);
}

// tan(x / 2) from tan(x).
float half_tan(float tangent) {
    return tangent / (1.0 + sqrt(1.0 + tangent * tangent));
}

vec3 veil_sample(float u, float weight, vec3 cone, vec3 first, vec3 rate) {
    u = u >= 0.0 ? min(u, 1e5) : 1e5;  // rounding at far points of the ray
    float square = u * u;
    float inverse = 1.0 / (1.0 + square);
    float cosine = 2.0 * u * inverse;
    float sine = 1.0 - 2.0 * inverse;
    float share = clamp(cone.x * cosine + cone.y * sine + cone.z, 0.0, 1.0);
    float q = sqrt(sqrt(square * inverse));
    float log_phase = v_phase_high.w;
    log_phase = log_phase * q + v_phase_high.z;
    log_phase = log_phase * q + v_phase_high.y;
    log_phase = log_phase * q + v_phase_high.x;
    log_phase = log_phase * q + v_phase_low.w;
    log_phase = log_phase * q + v_phase_low.z;
    log_phase = log_phase * q + v_phase_low.y;
    log_phase = log_phase * q + v_phase_low.x;
    return exp(log_phase - first - rate * u) * (weight * share * share * (3.0 - 2.0 * share));
}

vec3 lamp_veil(int i, vec3 ray, float range) {
    vec3 to_lamp = v_lamp_position[i].xyz;
    vec3 axis = v_lamp_axis[i].xyz;
    float foot = dot(ray, to_lamp);
    vec3 foot_vector = foot * ray - to_lamp;
    float height = max(length(foot_vector), 1e-3);
    float begin = 0.0;
    float end = range;
    float ray_axis = dot(ray, axis);
    if (v_lamp_cone[i].y > 0.5) {
        // A t^2 + 2 B t + C >= 0 is the inside of the cone and of its mirror image behind the lamp.
        float origin = v_lamp_cone[i].z;
        float a = ray_axis * ray_axis - v_lamp_cone[i].x;
        a = abs(a) < 1e-7 ? 1e-7 : a;
        float b = ray_axis * origin + v_lamp_cone[i].x * foot;
        float c = origin * origin - v_lamp_cone[i].x * v_lamp_cone[i].w;
        float discriminant = b * b - a * c;
        float root = sqrt(max(discriminant, 0.0));
        float inverse = 1.0 / a;
        float first = (-b - root) * inverse;
        float second = (-b + root) * inverse;
        float near = min(first, second);
        float far = max(first, second);
        bool is_lit = true;
        if (a > 0.0) {
            begin = ray_axis > 0.0 ? max(far, 0.0) : 0.0;
            end = ray_axis > 0.0 ? end : min(end, near);
        } else {
            is_lit = discriminant > 0.0 && origin + 0.5 * (near + far) * ray_axis > 0.0;
            begin = max(near, 0.0);
            end = min(end, far);
        }
        if (!is_lit || end <= begin) return vec3(0.0);
    }
    // Light that a lamp sends to the camera and the water scatters forward is in the blur of the lamp's own image.
    begin = max(begin, mix(begin, foot, v_lamp_strength[i].w));
    if (end <= begin) return vec3(0.0);
    float inverse_height = 1.0 / height;
    float low = half_tan((begin - foot) * inverse_height);
    float high = half_tan((end - foot) * inverse_height);
    float half_width = atan(half_tan((high - low) / max(1.0 + high * low, 1e-7)));  // a quarter of the angle between both ends
    float sum_tan = half_tan((high + low) / max(1.0 - high * low, 1e-7));
    float middle = (1.0 + sum_tan) / max(1.0 - sum_tan, 1e-7);
    float inner = tan_of(0.3399810435848563 * half_width);
    float outer = tan_of(0.8611363115940526 * half_width);
    float steepness = v_lamp_axis[i].w;
    vec3 cone = vec3(dot(foot_vector, axis) * inverse_height, ray_axis, -v_lamp_position[i].w) * steepness;
    vec3 first = v_veil_loss * foot;
    vec3 rate = v_veil_loss * height;
    vec3 sum = veil_sample(max(middle - outer, 0.0) / (1.0 + middle * outer), 0.3478548451374538, cone, first, rate)
        + veil_sample(max(middle - inner, 0.0) / (1.0 + middle * inner), 0.6521451548625461, cone, first, rate)
        + veil_sample((middle + inner) / (1.0 - middle * inner), 0.6521451548625461, cone, first, rate)
        + veil_sample((middle + outer) / (1.0 - middle * outer), 0.3478548451374538, cone, first, rate);
    return v_lamp_strength[i].rgb * sum * (6.283185307 * half_width * inverse_height);  // pi b I (high - low) / 2 / h
}
`;var Xc=`// Provides: lamplight(colour, unit_normal), the light of the lamps that a surface reflects.
// Needs: varyings.glsl and lamps.glsl with LAMPS; their shadow maps, four tiles of one texture.
// With MICROFACET, material.glsl replaces the colour.
// colour k I max(N.D, 0) / d^2 cone exp(-a d) * share of the light that no body blocks: see lamp.py.
uniform sampler2DShadow lamp_maps;

vec3 lamplight(vec3 colour, vec3 unit_normal) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LAMPS; ++i) {
#ifdef FLAT_LAMPS
        vec4 place = v_lamp_position[i];
        vec4 axis = v_lamp_axis[i];
        vec3 intensity = v_lamp_light[i];
#else
        vec4 place = lamp_position[i];
        vec4 axis = lamp_axis[i];
        vec3 intensity = lamp_light[i].rgb;
#endif
        vec3 towards = place.xyz - v_position;
        float distance = max(length(towards), 0.01);
        float facing = dot(unit_normal, towards) / distance;
        float cosine = dot(axis.xyz, towards) / distance;
        float cone_position = clamp((cosine - place.w) * axis.w, 0.0, 1.0);
        if (facing > 0.0 && cone_position > 0.0) {
            float cone = cone_position * cone_position * (3.0 - 2.0 * cone_position);
            float share = 1.0;  // a lamp that shines in all directions casts no shadows
            if (place.w > -1.0)
                share = textureLod(lamp_maps, v_lamp_uv[i].xyz / v_lamp_uv[i].w, 0.0);
#ifdef FLAT_LAMPS
            vec3 transmission = exp((v_lamp_loss[i] + v_lamp_spread[i] * sqrt(distance)) * -distance);
#elif defined(PHYSICAL)
            // c - b e of a wide target, as optics/lamp_light.py has it for the way there
            vec3 energy = lamp_optics[i].x - lamp_optics[i].y * sqrt(absorption.rgb * (2.0 * distance));
            vec3 transmission = exp((absorption.rgb + scattering.rgb * (1.0 - energy)) * -distance);
#else
            vec3 transmission = exp(v_attenuation * -distance);
#endif
            vec3 arriving = intensity * transmission * (facing * cone * share / (distance * distance));
#ifdef MICROFACET
            arriving *= reflected_share(unit_normal, towards / distance, facing);
#endif
            sum += arriving;
        }
    }
#ifdef MICROFACET
    return sum;
#else
    return colour * sum;
#endif
}
`;var jc=`// Provides: the block Lamps: the lamps of the vehicles.
// Needs: the switch LAMPS, the number of lamps, 1..4. Filled by lamps.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Lamps {
    mat4[4] lamp_from_camera;  // to homogeneous texture coordinates and depth in the shadow maps
    vec4[4] lamp_position;     // xyz [m]; w: cosine at the edge of the cone
    vec4[4] lamp_axis;         // xyz: opposite to the beam; w: factor from cosines inside the edge to 0..1
    vec4[4] lamp_light;        // rgb: intensity times colour; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var $c=`// Provides: light shafts: what the waves add to the sun's light that the water scatters into the camera, or take from it.
// Needs: frame.glsl, optics.glsl, caustics_block.glsl, caustics.glsl with MAP_LEVEL; the image of the surfaces; the switches
// RATIO, the edge of a texel in pixels, N_STEPS, and MAP_PERCENT, the edge of a mean of the map in percent of a step.
// b pi E_b / mu p(Theta) integral of exp(-c* t) (G - 1) over the way t in water: caustics/light_shafts.py.
#include "frame.glsl"
#include "optics.glsl"
#include "caustics_block.glsl"
#include "caustics.glsl"
uniform sampler2D surface_image;
out vec4 colour_out;

void main() {
    vec2 pixel = float(RATIO) * gl_FragCoord.xy;
    ivec2 last = textureSize(surface_image, 0) - 1;
    float range = texelFetch(surface_image, min(ivec2(pixel), last), 0).a;
    vec3 ray = ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz;
    float unit = inversesqrt(dot(ray, ray));
    ray *= unit;
    float depth = -up.w;
    float rise = dot(ray, up.xyz);
    vec3 loss = sun_loss.rgb * upwelling.w;  // c*
    float length = min(range, shaft_numbers.z);
    float surface_range = depth / max(rise, 1e-4);
    float ratio = rise > 0.0 && range > 0.8 * surface_range ? caustic_loss.w : 3.0;  // a body hides the sun's aureole
    if (rise > 0.0) length = min(length, surface_range);
    if (depth <= 0.0 || length <= 0.0) {
        colour_out = vec4(0.0);
        return;
    }
    vec2 start = vec2(caustic_x.w, caustic_y.w);
    vec2 drift = vec2(dot(ray, caustic_x.xyz), dot(ray, caustic_y.xyz));
    float speed = max(sqrt(dot(drift, drift)), 1e-4);  // across the beams [tiles/m]
    float longest = shaft_numbers.z * swell_frame.w / speed;
    float step_texels = speed * shaft_numbers.w;  // for each metre
    float pixel_texels = float(RATIO) * ray_column.x * unit * swell_frame.w * shaft_numbers.w;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < N_STEPS; ++i) {
        vec2 shares = vec2(i, i + 1) / float(N_STEPS);
        vec2 ends = longest * shares * shares;
        float width = min(ends.y, length) - ends.x;
        if (width <= 0.0) break;
        float way = ends.x + 0.5 * width;
        float map_level = log2(max(max(0.01 * float(MAP_PERCENT) * step_texels * width, pixel_texels * way), 1.0));
        float sample_depth = depth - rise * way;
        float excess = caustic_excess(start + drift * way, sample_depth, caustic_depths, swell_frame, map_level);
        sum += exp(loss * -way - (sun_loss.rgb + caustic_loss.rgb) * max(sample_depth, 0.0)) * (excess * width);
    }
    float cosine = dot(ray, sun.xyz);
    float q = sqrt(sqrt(max(0.5 - 0.5 * cosine, 1e-4)));
    vec4 high = phase_high;
    vec4 low = phase_low;
    float log_phase = ((high.w * q + high.z) * q + high.y) * q + high.x;
    log_phase = (((log_phase * q + low.w) * q + low.z) * q + low.y) * q + low.x;
    float g = shaft_numbers.x;
    float root = sqrt(max(1.0 + g * g - 2.0 * g * cosine, 1e-6));
    float scaled_phase = shaft_numbers.y * (1.0 - g * g) / (12.566371 * root * root * root);  // p* b* / b
    float phase = min(exp(log_phase), ratio * scaled_phase);
    colour_out = vec4(sun_beam.rgb * scattering.rgb * sum * (phase * 3.1415927 / upwelling.w), 0.0);
}
`;var Kc=`// Provides: with NORMAL_MAP, mapped_normal(unit_normal); with MICROFACET, prepare_material, material_daylight, reflected_share.
// Needs: varyings.glsl; with MICROFACET: daylight.glsl, the table of reflectance.py, and with FINISH_MAP a map of occlusion, roughness, metal.
// pi times the BRDF of a rough surface: Lambert under a layer of GGX's microfacets: reflectance.py.
#ifdef NORMAL_MAP
uniform sampler2D normal_map;

vec3 mapped_normal(vec3 unit_normal) {
    vec3 local = texture(normal_map, v_uv).xyz * (255.0 / 127.5) - 1.0;
    vec3 outward = gl_FrontFacing ? unit_normal : -unit_normal;
    vec3 across = cross(outward, v_tangent.xyz) * v_tangent.w;
    vec3 mapped = v_finish.z * (local.x * v_tangent.xyz + local.y * across) + local.z * outward;
    mapped *= inversesqrt(max(dot(mapped, mapped), 1e-12));
    return gl_FrontFacing ? mapped : -mapped;
}
#endif
#ifdef MICROFACET
#define MIN_ROUGHNESS 0.08  // these are the constants of reflectance.py; the indices are squared and relative to the medium
#define WATER_INDEX 1.2530631
#define AIR_INDEX 2.25
uniform sampler2D reflectance_table;
#ifdef FINISH_MAP
uniform sampler2D finish_map;
#endif
vec3 surface_view;      // towards the camera
vec3 surface_diffuse;   // albedo below the layer, times the light that passes the layer
vec3 surface_metal;     // colour of metal
vec3 surface_gain;      // factor on its reflection for light that microfacets reflect several times
vec4 surface_finish;    // x: roughness; y: share of metal; z: squared width; w: n.v
vec2 surface_factors;   // x: squared relative index of a dielectric; y: share of the diffuse daylight that arrives
vec3 surface_mirror;    // reflectance of the layer under even light

// Fresnel's reflectance of a dielectric, or Schlick's of a metal, from the cosine of incidence.
vec3 fresnel(float cosine) {
    float g = sqrt(surface_factors.x - 1.0 + cosine * cosine);
    float minus = g - cosine;
    float plus = g + cosine;
    float ratio = minus / plus;
    float second = (cosine * plus - 1.0) / (cosine * minus + 1.0);
    float dielectric = 0.5 * ratio * ratio * (1.0 + second * second);
    float rest = 1.0 - cosine;
    float power = rest * rest;
    power *= power * rest;
    return mix(vec3(dielectric), surface_gain * (surface_metal + (1.0 - surface_metal) * power), surface_finish.y);
}

// Set the variables above for a pixel; call it before the functions below.
void prepare_material(vec3 albedo, vec3 normal, float depth) {
    float roughness = v_finish.x;
    float metallic = v_finish.y;
    float occlusion = 1.0;
#ifdef FINISH_MAP
    vec3 finish_texel = texture(finish_map, v_uv).rgb;
    occlusion = finish_texel.r;
    roughness *= finish_texel.g;
    metallic *= finish_texel.b;
#endif
    roughness = max(roughness, MIN_ROUGHNESS);
    float width = roughness * roughness;
    surface_view = -v_position * inversesqrt(dot(v_position, v_position));
    float nv = clamp(dot(normal, surface_view), 0.001, 1.0);
    vec2 texels = vec2(textureSize(reflectance_table, 0));
    vec3 table = textureLod(reflectance_table, (vec2(nv, roughness) * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
    bool is_wet = depth > 0.0;
    float dielectric = is_wet ? table.g : table.b;
    surface_finish = vec4(roughness, metallic, width * width, nv);
    surface_factors = vec2(is_wet ? WATER_INDEX : AIR_INDEX, occlusion);
    surface_metal = albedo;
    surface_diffuse = albedo * ((1.0 - metallic) * (1.0 - dielectric));
    surface_gain = 1.0 + albedo * (1.0 / table.r - 1.0);
    surface_mirror = mix(vec3(dielectric), albedo * table.r * surface_gain, metallic);
}

// The share of a beam that the camera receives, pi times the BRDF; facing = normal . towards > 0.
vec3 reflected_share(vec3 normal, vec3 towards, float facing) {
    vec3 middle = towards + surface_view;
    middle *= inversesqrt(max(dot(middle, middle), 1e-12));
    float nh = dot(normal, middle);
    float square = surface_finish.z;
    float nv = surface_finish.w;
    float nl = max(facing, 1e-4);
    float peak = nh * nh * (square - 1.0) + 1.0;
    float shadowing = nl * sqrt(nv * nv * (1.0 - square) + square) + nv * sqrt(nl * nl * (1.0 - square) + square);
    float facets = 0.5 * square / (peak * peak * shadowing);
    return surface_diffuse + facets * fresnel(clamp(dot(surface_view, middle), 0.0, 1.0));
}

// The light of sun and sky that the surface reflects; the arguments are those of daylight.
vec3 material_daylight(vec3 normal, float facing, float upward, float share, float depth) {
    vec3 even = daylight(0.0, upward, share, depth);
    vec3 beam = daylight(1.0, upward, share, depth) - even;
    float mirrored_up = 2.0 * dot(normal, surface_view) * upward - dot(surface_view, v_up);
    float lobe = clamp(mirrored_up / surface_finish.x, -1.0, 1.0);
    vec3 mirrored = daylight(0.0, lobe, share, depth);
    vec3 total = surface_factors.y * (even * surface_diffuse + mirrored * surface_mirror);
    if (facing > 0.0) total += beam * (facing * reflected_share(normal, v_sun, facing));
    return total;
}
#endif
`;var Qc=`// Provides: open_water(pixel, size), the radiance of open water behind a pixel; open_water_place(share), its place in the texture.
// Needs: the small texture of physical/open_water_map.py.
// Pixels count as gl_FragCoord does; shares are those of the image's width and height. The texture's outer texels are at the corners.
uniform sampler2D open_water_map;

vec2 open_water_place(vec2 share) {
    vec2 texels = vec2(textureSize(open_water_map, 0));
    return (share * (texels - 1.0) + 0.5) / texels;
}

vec3 open_water(vec2 pixel, vec2 size) {
    return textureLod(open_water_map, open_water_place(pixel / size), 0.0).rgb;
}
`;var Jc=`// Provides: the block Optics, the numbers of physical water; and FAR, the range of pixels without a surface.
// Needs: nothing. Filled by physical/optics_block.py, where the same members are declared.
// Rays are in the camera frame (OpenGL axes), with z = -1, linear in gl_FragCoord.
#ifndef FAR
#define FAR 1e9
#endif
layout(std140) uniform Optics {
    vec4 absorption;       // rgb: a [1/m]; w: e0 of the whole field
    vec4 scattering;       // rgb: b [1/m]; w: k of the whole field
    vec4[2] reach;         // factors on the ranges of the levels of blur: blur_plan.py
    vec4 camera;           // y: exposure; z: middle range of the table of weights [m]
    vec4 sun_beam;         // rgb: irradiance of a level surface just below the surface by the sun
    vec4 sun_loss;         // rgb: its attenuation over depth [1/m]
    vec4 daylight_total;   // rgb: irradiance of a level surface just below the surface
    vec4 daylight_loss;    // rgb: its attenuation over depth [1/m]
    vec4 upwelling;        // rgb: share of the irradiance that comes up; w: cosine of the sun from the zenith
    vec4 phase_low;        // ln p as a polynomial of ((1 - cos) / 2)^(1/4): the lower four coefficients
    vec4 phase_high;       // the higher four
    vec4 ray_first;        // the ray at gl_FragCoord = 0
    vec4 ray_column;       // its change from column to column
    vec4 ray_row;          // its change from row to row
    vec4[4] lamp_optics;   // x: EE(half angle) - A; y: k_L; z: squared cosine of the half angle; w: 1 if it is below 90 degrees
};
`;var Zc=`// Provides: projected(dry, colour, unit_normal), the light of a surface with the projected pattern.
// Needs: varyings.glsl and projector.glsl with PROJECTOR; the textures of the pattern and of the shadow map.
// A laser replaces the light by the pattern's colour, 0 or 1 in each channel, times exp(-a d). A lamp adds
// colour p max(N.D, 0) / d^2 exp(-a d) * share of the light that no body blocks: see projector.py.
uniform sampler2DShadow projector_map;
uniform sampler2D projector_pattern;

vec3 projected(vec3 dry, vec3 colour, vec3 unit_normal) {
    vec3 map_point = v_projector_uv.xyz / v_projector_uv.w;
    vec3 towards = projector_position.xyz - v_position;
    float distance = max(length(towards), 0.01);
    float facing = dot(unit_normal, towards) / distance;
    vec2 outside = step(0.5, abs(map_point.xy - 0.5));
    if (v_projector_uv.w <= 0.1 || facing <= 0.0 || outside.x + outside.y > 0.0) return dry;
    vec4 pattern = textureLod(projector_pattern, map_point.xy, 0.0);
    if (pattern.a < 0.5) return dry;
    float share = textureLod(projector_map, vec3(map_point.xy, min(map_point.z, 1.0)), 0.0);
    vec3 transmission = exp(v_attenuation * -distance);
    if (projector_position.w < 0.5)
        return dry + colour * pattern.rgb * transmission * (share * facing / (distance * distance));
    vec3 beam = step(0.5, pattern.rgb);
    float channels = beam.r + beam.g + beam.b;
    bool is_white = min(pattern.r, min(pattern.g, pattern.b)) >= 1.0;
    return share < 0.5 || channels < 0.5 || is_white ? dry : beam * transmission;
}
`;var ef=`// Provides: the block Projector: the projector of a pattern.
// Needs: nothing. Filled by projector_light.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Projector {
    mat4 projector_from_camera;  // to homogeneous texture coordinates and depth in the shadow map
    vec4 projector_position;     // xyz [m]; w: 1 laser, 0 lamp
    vec4 projector_axis;         // xyz: opposite to the beam; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var tf=`// Provides: the levels of blur after the second, each at half the resolution: texels weighed by 1, 3, 3, 1 along rows and columns.
// Needs: the textures of the levels; the switch N_LEVELS, how many there are, 1 to 6.
// Four linear look-ups are the sixteen weights; those outside the level have none.
uniform sampler2D level_0;
uniform sampler2D level_1;
uniform sampler2D level_2;
uniform sampler2D level_3;
uniform sampler2D level_4;
uniform sampler2D level_5;
layout(location = 0) out vec4[N_LEVELS] level_out;

vec4 smooth_mean(sampler2D level) {
    vec2 size = vec2(textureSize(level, 0));
    vec2 low = (2.0 * gl_FragCoord.xy - 0.75) / size;
    vec2 high = low + 1.5 / size;
    vec2 inside = step(high, vec2(1.0));
    vec4 sum = texture(level, low) + inside.x * inside.y * texture(level, high)
        + inside.y * texture(level, vec2(low.x, high.y))
        + inside.x * texture(level, vec2(high.x, low.y));
    return sum / ((1.0 + inside.x) * (1.0 + inside.y));
}

void main() {
    level_out[0] = smooth_mean(level_0);
#if N_LEVELS > 1
    level_out[1] = smooth_mean(level_1);
#endif
#if N_LEVELS > 2
    level_out[2] = smooth_mean(level_2);
#endif
#if N_LEVELS > 3
    level_out[3] = smooth_mean(level_3);
#endif
#if N_LEVELS > 4
    level_out[4] = smooth_mean(level_4);
#endif
#if N_LEVELS > 5
    level_out[5] = smooth_mean(level_5);
#endif
}
`;var rf=`// Provides: the light that levels of blur scatter, w_l (J - B), before their Gaussians.
// Needs: blur_weight.glsl, open_water.glsl; scattered.vert.glsl; the image of the surfaces; the switches N_LEVELS, and FAR of optics.glsl.
// The first run is at half the resolution and for one level; its last output is the mean of J - B, with the mean range as alpha, or FAR.
// The second run has the switch WIDE: it is twice as coarse, for all other levels, and reads that mean.
// J: radiance of a surface without water, B: of open water behind it. Pixels without a surface scatter nothing.
#define VARYING in
#define READS_VARYINGS
#include "optics.glsl"
#include "blur_weight.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
flat in ivec2 v_last;
flat in vec4[2] v_reach;
#ifndef WIDE
noperspective in vec2 v_water_place;
#endif
#ifdef WIDE
#define FIRST 1
layout(location = 0) out vec4[N_LEVELS] level_out;
#else
#define FIRST 0
layout(location = 0) out vec4[N_LEVELS + 1] level_out;
#endif

vec4 scattered(int level, float range, vec3 excess) {
    return vec4(weight(1 + level, v_reach[level / 4][level % 4] * range) * excess, 0.0);
}

void main() {
    ivec2 corner = 2 * ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    float ranges = 0.0;
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 texel = texelFetch(surface_image, min(corner + ivec2(i % 2, i / 2), v_last), 0);
        float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
        sum += texel.rgb * is_surface;
        ranges += texel.a * is_surface;
        count += is_surface;
    }
    float range = ranges / max(count, 1.0);
#ifndef WIDE
    sum -= count * texture(open_water_map, v_water_place).rgb;
#endif
    vec3 excess = sum / 4.0;
    // no loop: WebGL's outputs have constant indices
#if N_LEVELS > 0
    level_out[0] = scattered(FIRST + 0, range, excess);
#endif
#if N_LEVELS > 1
    level_out[1] = scattered(FIRST + 1, range, excess);
#endif
#if N_LEVELS > 2
    level_out[2] = scattered(FIRST + 2, range, excess);
#endif
#if N_LEVELS > 3
    level_out[3] = scattered(FIRST + 3, range, excess);
#endif
#if N_LEVELS > 4
    level_out[4] = scattered(FIRST + 4, range, excess);
#endif
#if N_LEVELS > 5
    level_out[5] = scattered(FIRST + 5, range, excess);
#endif
#if N_LEVELS > 6
    level_out[6] = scattered(FIRST + 6, range, excess);
#endif
#ifndef WIDE
    level_out[N_LEVELS] = vec4(excess, count > 0.0 ? range : FAR);
#endif
}
`;var sf=`// Provides: one triangle over the whole target, with the place of each texel in the open water, and constants of the pass.
// Needs: optics.glsl, open_water.glsl, blur_weight.glsl; the image of the surfaces; the switches of scattered.frag.glsl.
// llvmpipe reads flat varyings much faster than uniforms in each pixel.
#define VARYING out
#include "optics.glsl"
#include "open_water.glsl"
#include "blur_weight.glsl"
uniform sampler2D surface_image;
flat out ivec2 v_last;   // the last pixel of the image
flat out vec4[2] v_reach;
#ifndef WIDE
noperspective out vec2 v_water_place;
#endif

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    ivec2 size = textureSize(surface_image, 0);
    v_last = size - 1;
    v_reach[0] = reach[0];
    v_reach[1] = reach[1];
    pass_on_table();
#ifndef WIDE
    vec2 texels = vec2((size + 1) / 2);  // of the target
    v_water_place = open_water_place((corner + 1.0) * texels / vec2(size));
#endif
}
`;var nf=`// Provides: one triangle over the whole target, without depth; with the switch BEHIND at the far plane.
// Needs: nothing; three vertices without attributes.
// For the passes of physical water that work on whole images.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
#ifdef BEHIND
    gl_Position = vec4(corner, 1.0, 1.0);
#else
    gl_Position = vec4(corner, 0.0, 1.0);
#endif
}
`;var af=`// Provides: depth only, which the rasteriser writes.
// Needs: with ALPHA_TEST, the alpha of holes, 1..255 of 255, a texture of the base colour.
// For all shadow maps.
#ifdef ALPHA_TEST
uniform sampler2D base_map;
in vec2 v_uv;
#endif

void main() {
#ifdef ALPHA_TEST
    if (texture(base_map, v_uv).a < float(ALPHA_TEST) / 255.0) discard;
#endif
}
`;var of=`// Provides: sun_share(map_point), 0 in the sun's shadow to 1 in full sunlight; with HULLS, sky_share(map_point, scale).
// Needs: the shadow map; map_point = texture coordinates and depth of a point in it, 0..1.
// One hardware comparison of 2 x 2 texels, or with the switch SOFT the mean of four; points outside the map are lit.
uniform sampler2DShadow shadow_map;

float sun_share(vec3 map_point) {
    vec3 inside = step(abs(map_point - 0.5), vec3(0.5));
#ifdef SOFT
    if (inside.x * inside.y * inside.z == 0.0) return 1.0;
    vec2 texel = 1.25 / vec2(textureSize(shadow_map, 0));
    float sum = 0.0;
    for (int i = -1; i <= 1; i += 2)
        for (int j = -1; j <= 1; j += 2) sum += textureLod(shadow_map, map_point + vec3(vec2(i, j) * texel, 0.0), 0.0);
    return sum / 4.0;
#else
    return inside.x * inside.y * inside.z > 0.0 ? texture(shadow_map, map_point) : 1.0;
#endif
}

#ifdef HULLS
// The share of diffuse light that hulls let through, by eight rays along the sun's, up to 2 m beside the point.
// scale = texture coordinates and depth of the map for each metre. The rays begin on a cone of 45 degrees above the point.
float sky_share(vec3 map_point, vec2 scale) {
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        float radius = 2.0 * sqrt((float(i) + 0.5) / 8.0);
        float angle = 2.3999632 * float(i);
        vec3 offset = radius * vec3(scale.x * cos(angle), scale.x * sin(angle), -scale.y);
        sum += sun_share(map_point + offset);
    }
    return sum / 8.0;
}
#endif
`;var lf=`// Provides: the vertices of a shadow caster in the view of a light.
// Needs: instance.glsl, filled with matrices to the light's clip space instead of the camera frame.
// Used for the shadow maps of the sun, the lamps and the projector. With ALPHA_TEST, it has holes.
#include "instance.glsl"

in vec3 vertex;
#ifdef ALPHA_TEST
in vec2 uv;
out vec2 v_uv;
#endif

void main() {
    gl_Position = camera_from_model * vec4(vertex, 1.0);
#ifdef ALPHA_TEST
    v_uv = uv;
#endif
}
`;var cf=`// Provides: sunlit(colour, facing, mirrored, lit), the sunlight and ambient light that a surface reflects.
// Needs: varyings.glsl; facing = N.L; mirrored = R.E; lit = share of the sunlight that arrives, 0..1. N: normal,
// L: direction to the sun, R: direction of the mirrored sunlight, E: direction to the camera.
// With the switch POLISHED: surfaces are glossy, 0.3 max(R.E, 0)^32, and in the shade ambient light has the
// water's hue.
// Else UWSim's image model: q (Ia C + Id C max(N.L, 0) + Is max(R.E, 0)^2 where N.L > 0), with light rate q, surface
// colour C, and the ambient, diffuse and specular light Ia, Id, Is.
vec3 sunlit(vec3 colour, float facing, float mirrored, float lit) {
    float reached = facing > 0.0 ? lit : 0.0;
    float glint = max(mirrored, 0.0);
#ifdef POLISHED
    vec3 hue = v_water_colour.rgb / max(max(v_water_colour.r, v_water_colour.g), max(v_water_colour.b, 1e-3));
    vec3 ambient = v_lights.w * mix(0.8 + 0.35 * hue, vec3(1.0), reached);
    float narrow = glint * glint * glint * glint;
    narrow *= narrow;
    narrow *= narrow;
    narrow *= narrow;
    vec3 film = v_lights.rgb * (0.3 * narrow * reached);
    return colour * (ambient + v_lights.rgb * (facing * reached)) + film;
#endif
    return colour * (v_lights.w + v_lights.rgb * (facing * reached)) + v_water_colour.w * glint * glint * reached;
}
`;var ff=`// Provides: colour, range and id of a surface seen through water, whichever are requested.
// Needs: varyings.glsl, instance.glsl, sun.glsl, water.glsl, grey.glsl, shadow.glsl, lamplight.glsl, projection.glsl, targets.glsl, material.glsl.
// The switch ALPHA_TEST is the alpha of holes, 1..255 of 255. EMISSION and EMISSION_MAP add emitted light, under PHYSICAL only.
// The switch MIRROR leaves out what is above the still surface (2), or below it (1): surface/mirror_view.py.
// The switch OPACITY is 1..254 of 255; without it the surface is opaque. The renderer blends.
// Light, then attenuation, then fog, on stored values; noise and conversion to 8 bit follow in noise.py.
#define VARYING in
#include "varyings.glsl"
#include "targets.glsl"
#ifdef IDS
#include "instance.glsl"
#endif
#ifdef COLOUR
#ifdef PHYSICAL
#include "optics.glsl"
#include "daylight.glsl"
#ifdef SKY
#include "surface_block.glsl"
#include "skylight.glsl"
#endif
#else
#include "sun.glsl"
#include "water.glsl"
#endif
#include "grey.glsl"
#if defined(NORMAL_MAP) || defined(MICROFACET)
#include "material.glsl"
#endif
#ifdef EMISSION_MAP
uniform sampler2D emission_map;
#endif
#ifdef SHADOWS
#include "shadow.glsl"
#endif
#ifdef LAMPS
#include "lamps.glsl"
#include "lamplight.glsl"
#endif
#ifdef PROJECTOR
#include "projector.glsl"
#include "projection.glsl"
#endif
#endif
#if defined(TEXTURED) && (defined(COLOUR) || defined(ALPHA_TEST))
uniform sampler2D base_map;
#endif

void main() {
#ifdef ALPHA_TEST
    vec4 base = texture(base_map, v_uv);
    if (base.a < float(ALPHA_TEST) / 255.0) discard;
#endif
#if defined(COLOUR) || defined(RANGE)
    float range = length(v_position);
#endif
#ifdef MIRROR
    if (v_terms.z * (float(MIRROR) - 1.5) < 0.0) discard;
#endif
#ifdef COLOUR
    vec3 colour = v_base_colour;
#ifdef ALPHA_TEST
    colour *= base.rgb;
#elif defined(TEXTURED)
    colour *= texture(base_map, v_uv).rgb;
#endif
    float unit = inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    unit = gl_FrontFacing ? unit : -unit;
#ifdef NORMAL_MAP
    vec3 normal = mapped_normal(v_normal * unit);
    float facing = dot(normal, v_sun);
#else
    vec3 normal = v_normal * unit;
    float facing = v_terms.x * unit;
#endif
#ifdef PHYSICAL
    colour = albedo_of(colour);
#ifdef NORMAL_MAP
    float upward = dot(normal, v_up);
#else
    float upward = v_terms.w * unit;
#endif
#elif defined(NORMAL_MAP)
    float mirrored = (v_terms.y - 2.0 * facing * dot(normal, v_position)) / range;
#else
    float mirrored = (v_terms.y - 2.0 * facing * unit * dot(v_normal, v_position)) / range;
#endif
    float lit = 1.0;
#ifdef SHADOWS
    lit = sun_share(v_shadow_uv);
#ifdef HULLS
    sky_arrival = sky_share(v_shadow_uv, v_shadow_scale);
#endif
#endif
#if defined(PHYSICAL) && defined(CAUSTICS)
    focus_beam(v_terms.z);
#endif
#ifdef FOG_CLIP
    float fog_range = v_terms.w;
#else
    float fog_range = range;
#endif
#ifdef MICROFACET
    prepare_material(colour, normal, v_terms.z);
    vec3 dry = material_daylight(normal, facing, upward, lit, v_terms.z);
#elif defined(PHYSICAL)
    vec3 dry = colour * daylight(facing, upward, lit, v_terms.z);
#else
    vec3 dry = sunlit(colour, facing, mirrored, lit);
#endif
#ifdef SKY
    if (v_terms.z < 0.0) dry = colour * skylight(normal, lit);
#endif
#ifdef LAMPS
    dry += lamplight(colour, normal);
#endif
#ifdef PROJECTOR
    dry = projected(dry, colour, normal);
#endif
#ifdef EMISSION
    vec3 emitted = v_emission;
#ifdef EMISSION_MAP
    emitted *= albedo_of(texture(emission_map, v_uv).rgb);
#endif
    dry += emitted;
#endif
#ifdef AIR
    float deeper = max(v_terms.z, v_camera_depth);
    float wet = clamp(deeper / max(deeper - min(v_terms.z, v_camera_depth), 1e-6), 0.0, 1.0);
    fog_range *= wet;
    float water_range = range * wet;
#else
    float water_range = range;
#endif
#ifdef OPACITY
    float opacity = float(OPACITY) / 255.0;
#else
    float opacity = 1.0;
#endif
#ifdef PHYSICAL
#ifdef OPACITY
    colour_out = vec4(dry, opacity);
#else
    colour_out = vec4(dry, water_range);  // the water follows in whole images: physical/development.py
#endif
#else
    colour_out = vec4(camera_colour(through_water(dry, water_range, fog_range, v_terms.z)), opacity);
#endif
#endif
#ifdef RANGE
    range_out = range;
#endif
#ifdef IDS
    id_out = identity.x;
#endif
}
`;var uf=`// Provides: the vertices of a model, in the camera frame and on the image.
// Needs: frame.glsl, instance.glsl, varyings.glsl, lamps.glsl, projector.glsl.
// Terms that are linear in space are computed here; their interpolation is exact.
#define VARYING out
#include "frame.glsl"
#include "instance.glsl"
#include "varyings.glsl"
#if defined(COLOUR) && defined(PHYSICAL)
#include "optics.glsl"
#ifdef CAUSTICS
#include "caustics_block.glsl"
#endif
#endif
#if defined(COLOUR) && defined(LAMPS)
#include "lamps.glsl"
#endif
#if defined(COLOUR) && defined(PROJECTOR)
#include "projector.glsl"
#endif

in vec3 vertex;
#ifdef COLOUR
in vec3 vertex_normal;
in vec3 tint;
#ifdef NORMAL_MAP
in vec4 tangent;
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
in vec3 finish;
#endif
#ifdef EMISSION
in vec3 emission;
#endif
#endif
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
in vec2 uv;
#endif

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    v_position = point.xyz;
    gl_Position = clip_from_camera * point;
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
    v_uv = uv;
#endif
#ifdef COLOUR
    v_normal = mat3(camera_normals) * vertex_normal;
    v_terms.x = dot(v_normal, sun.xyz);
    v_terms.y = dot(v_position, sun.xyz);
    v_terms.z = -(dot(v_position, up.xyz) + up.w);
#ifdef PHYSICAL
    v_terms.w = dot(v_normal, up.xyz);
#else
    v_terms.w = clip_fog.y - clip_fog.x * v_position.z;
#endif
    v_base_colour = tint;
    v_attenuation = attenuation.rgb;
#ifdef PHYSICAL
    v_sun_beam = vec4(sun_beam.rgb, upwelling.w);
    v_sun_loss = sun_loss.rgb;
    v_daylight_total = daylight_total.rgb;
    v_daylight_loss = daylight_loss.rgb;
    v_upwelling = upwelling.rgb;
#ifdef CAUSTICS
    v_caustic_place = vec2(dot(v_position, caustic_x.xyz), dot(v_position, caustic_y.xyz)) + vec2(caustic_x.w, caustic_y.w);
    v_caustic_depths = caustic_depths;
    v_swell_frame = swell_frame;
    v_caustic_loss = caustic_loss.rgb;
#endif
#else
    v_lights = vec4(sunlight.rgb, ambient_specular.x);
    v_water_colour = vec4(water_colour.rgb, ambient_specular.y);
    v_fog = fog;
#endif
#ifdef NORMAL_MAP
    mat3 rotation = mat3(camera_from_model);
    vec3 along = rotation * tangent.xyz;
    v_tangent = vec4(along * inversesqrt(max(dot(along, along), 1e-12)), tangent.w * sign(determinant(rotation)));
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
    v_sun = sun.xyz;
    v_up = up.xyz;
    v_finish = finish;
#endif
#ifdef EMISSION
    v_emission = emission;
#endif
#ifdef AIR
    v_camera_depth = -up.w;
#endif
#ifdef SHADOWS
#ifdef SOFT
    float lift = 2.5 * sun.w;  // look-ups are wider
#else
    float lift = sun.w;
#endif
    vec3 lifted = v_position + v_normal * (lift * inversesqrt(max(dot(v_normal, v_normal), 1e-12)));
    v_shadow_uv = (shadow_from_camera * vec4(lifted, 1.0)).xyz;
#ifdef HULLS
    mat3 across = transpose(mat3(shadow_from_camera));
    v_shadow_scale = vec2(length(across[0]), length(across[2]));
#endif
#endif
#ifdef LAMPS
    vec3 unit_normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - v_position;
        float lift = lamp_light[i].w * dot(towards, lamp_axis[i].xyz) * sign(dot(unit_normal, towards));
        v_lamp_uv[i] = lamp_from_camera[i] * vec4(v_position + unit_normal * lift, 1.0);
#ifdef FLAT_LAMPS
        v_lamp_position[i] = lamp_position[i];
        v_lamp_axis[i] = lamp_axis[i];
        v_lamp_light[i] = lamp_light[i].rgb;
        v_lamp_loss[i] = absorption.rgb + scattering.rgb * (1.0 - lamp_optics[i].x);
        v_lamp_spread[i] = scattering.rgb * sqrt(2.0 * absorption.rgb) * lamp_optics[i].y;
#endif
    }
#endif
#ifdef PROJECTOR
    vec3 outwards = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    vec3 back = projector_position.xyz - v_position;
    float raise = projector_axis.w * dot(back, projector_axis.xyz) * sign(dot(outwards, back));
    v_projector_uv = projector_from_camera * vec4(v_position + outwards * raise, 1.0);
#endif
#endif
}
`;var hf=`// Provides: the requested outputs; the switches COLOUR, RANGE and IDS are their locations, or undefined.
// Needs: nothing.
// Colour: stored values 0..1. Range: along the ray [m], inf: no surface. Id 0: no surface.
#ifdef COLOUR
layout(location = COLOUR) out vec4 colour_out;
#endif
#ifdef RANGE
layout(location = RANGE) out float range_out;
#endif
#ifdef IDS
layout(location = IDS) out uint id_out;
#endif
`;var df=`// Provides: whole_field(range), the share of a wide target's light that arrives.
// Needs: optics.glsl.
// Formula: optics/transmission.py.
vec3 whole_field(float range) {
    vec3 absorbed = absorption.rgb * range;
    vec3 wide_loss = scattering.w * sqrt(absorbed) + vec3(absorption.w);
    return exp(-absorbed - scattering.rgb * range * wide_loss);
}
`;var mf=`// Provides: the varyings of a surface; VARYING is \`out\` in the vertex shader, \`in\` in the fragment shader.
// Needs: the switches COLOUR, TEXTURED, SHADOWS, AIR, PROJECTOR, and LAMPS, the number of lamps; those of material.glsl.
// Flat varyings pass on constants of the block Frame: llvmpipe reads them much faster than uniforms in each pixel.
#if defined(TEXTURED) || defined(NORMAL_MAP) || defined(FINISH_MAP) || defined(EMISSION_MAP)
#define HAS_UV
#endif
VARYING vec3 v_position;  // camera frame [m]
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
VARYING vec2 v_uv;  // texture coordinates
#endif
#ifdef COLOUR
VARYING vec3 v_normal;  // camera frame, any length
VARYING vec4 v_terms;  // x: N.L |N|; y: P.L [m] (L: to the sun, P: position); z: depth below the water's surface [m]; w: clip-space z [m], PHYSICAL: N.up |N|
flat VARYING vec3 v_base_colour;  // colour of the mesh
flat VARYING vec3 v_attenuation;  // attenuation of rgb [1/m]
#ifdef PHYSICAL
flat VARYING vec4 v_sun_beam;  // these are sun_beam, sun_loss ... of optics.glsl; w: upwelling.w
flat VARYING vec3 v_sun_loss;
flat VARYING vec3 v_daylight_total;
flat VARYING vec3 v_daylight_loss;
flat VARYING vec3 v_upwelling;
#ifdef CAUSTICS
VARYING vec2 v_caustic_place;  // where the sun's beam to the point enters the water [tiles]
flat VARYING vec4 v_caustic_depths;  // these are of caustics_block.glsl
flat VARYING vec4 v_swell_frame;
flat VARYING vec3 v_caustic_loss;
#endif
#else
flat VARYING vec4 v_lights;  // rgb: sunlight; w: ambient
flat VARYING vec4 v_water_colour;  // rgb: water colour; w: specular
flat VARYING vec4 v_fog;  // rgb: fog colour; w: density squared [1/m2]
#endif
#ifdef NORMAL_MAP
VARYING vec4 v_tangent;  // xyz: camera frame; w: 1, or -1 where the texture is mirrored
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
flat VARYING vec3 v_sun;  // towards the sun, camera frame
flat VARYING vec3 v_up;  // W's z axis, camera frame
flat VARYING vec3 v_finish;  // x: roughness; y: share of metal; z: scale of the normal map
#endif
#ifdef EMISSION
flat VARYING vec3 v_emission;  // emitted radiance
#endif
#ifdef AIR
flat VARYING float v_camera_depth;  // depth of the camera below the water's surface [m]
#endif
#ifdef SHADOWS
VARYING vec3 v_shadow_uv;  // texture coordinates and depth in the shadow map, 0..1
#ifdef HULLS
VARYING vec2 v_shadow_scale;  // texture coordinates and depth of the shadow map for each metre
#endif
#endif
#ifdef LAMPS
VARYING vec4[LAMPS] v_lamp_uv;  // homogeneous texture coordinates and depth in the lamps' shadow maps
#if defined(PHYSICAL) && LAMPS <= 2 && !defined(GL_ES)  // browsers guarantee fewer varyings
#define FLAT_LAMPS
flat VARYING vec4[LAMPS] v_lamp_position;  // these are lamp_position, lamp_axis and lamp_light of lamps.glsl
flat VARYING vec4[LAMPS] v_lamp_axis;
flat VARYING vec3[LAMPS] v_lamp_light;
flat VARYING vec3[LAMPS] v_lamp_loss;  // attenuation of the way from the lamp of the length d: exp(-d (loss + spread sqrt(d)))
flat VARYING vec3[LAMPS] v_lamp_spread;
#endif
#endif
#ifdef PROJECTOR
VARYING vec4 v_projector_uv;  // homogeneous texture coordinates and depth in the projector's shadow map
#endif
#endif
`;var pf=`// Provides: the numbers of the lamps and of the water for lamp_veil.glsl as flat varyings.
// Needs: VARYING, \`out\` in the vertex shader, which needs optics.glsl and lamps.glsl and calls pass_on_lamps(), and \`in\` in the fragment
// shader, with READS_VARYINGS; the switch LAMPS. llvmpipe reads flat varyings much faster than uniforms in each pixel.
flat VARYING vec4[LAMPS] v_lamp_position;  // xyz: camera frame [m]; w: cosine at the edge of the cone
flat VARYING vec4[LAMPS] v_lamp_axis;      // xyz: along the beam; w: factor from cosines inside the edge to 0..1
flat VARYING vec4[LAMPS] v_lamp_cone;      // x: squared cosine of the half angle; y: 1 if it is below 90 degrees; z: place of the camera along the axis [m]; w: squared distance of the camera [m2]
flat VARYING vec4[LAMPS] v_lamp_strength;  // rgb: b times intensity; w: share of the light that is sent to the camera, 0..1
flat VARYING vec3 v_veil_loss;             // c - 0.97 b [1/m]
flat VARYING vec4 v_phase_low;             // these are of optics.glsl
flat VARYING vec4 v_phase_high;
#ifndef READS_VARYINGS
void pass_on_lamps() {
    v_veil_loss = absorption.rgb + 0.03 * scattering.rgb;
    v_phase_low = phase_low;
    v_phase_high = phase_high;
    for (int i = 0; i < LAMPS; ++i) {
        vec3 to_lamp = lamp_position[i].xyz;
        float square = dot(to_lamp, to_lamp);
        float along = dot(to_lamp, lamp_axis[i].xyz);  // the beam goes the other way
        float cosine = along / max(sqrt(square), 1e-3);
        v_lamp_position[i] = lamp_position[i];
        v_lamp_axis[i] = vec4(-lamp_axis[i].xyz, lamp_axis[i].w);
        v_lamp_cone[i] = vec4(lamp_optics[i].z, lamp_optics[i].w, along, square);
        v_lamp_strength[i] = vec4(scattering.rgb * lamp_light[i].rgb, lamp_position[i].w > -1.0 ? clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0);
    }
}
#endif
`;var vf=`// Provides: through_water(lit, range, fog_range, depth), the colour of a surface at the camera.
// Needs: varyings.glsl; the switch NO_FOG if the fog density is 0; range: along the ray in water, fog_range: distance in
// the fog, depth: below the water's surface [m].
// lit E + w (1 - E exp(-0.001 depth)) with E = exp(-2 a range), then fog with exp(-(f fog_range)^2): see water.py.
vec3 through_water(vec3 lit, float range, float fog_range, float depth) {
    vec3 transmission = exp(v_attenuation * (-2.0 * range));
    float dimmed = exp(-0.001 * max(depth, 0.0));
    vec3 colour = transmission * (lit - v_water_colour.rgb * dimmed) + v_water_colour.rgb;
#ifdef NO_FOG
    return colour;
#else
    return mix(v_fog.rgb, colour, exp(-v_fog.w * fog_range * fog_range));
#endif
}
`;var gf=`// Provides: coverage D (J - B) of a particle, and its coverage as alpha; the renderer draws it over those behind.
// Needs: the outputs of particle.vert.glsl; the image of the surfaces.
// J: radiance of the particle, B: of open water behind its centre, D = exp(-c r). Nearer surfaces hide it.
uniform sampler2D surface_image;
flat in vec4 v_light;
flat in vec4 v_shape;
noperspective in vec2 v_offset;
out vec4 colour_out;

void main() {
    vec2 inner = v_offset / v_shape.xy;
    float square = dot(inner, inner);
    float inside = 1.0 - square;
    if (inside <= 0.0) discard;
    float range = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0).a;
    if (range < v_light.a) discard;
    float profile = 3.0 * inside * inside;
    // the rim of a bubble is seen if its image is large enough
    if (v_shape.w > 0.5) profile = mix(profile, 30.0 * square * square * inside * inside, clamp(0.5 * v_shape.y - 1.0, 0.0, 0.85));
    float coverage = min(v_shape.z * profile, 1.0);
    colour_out = coverage * vec4(v_light.rgb, 1.0);
}
`;var _f=`// Provides: the rectangle around the image of a particle, and the light D (J - B) that it adds to open water.
// Needs: frame.glsl, optics.glsl, open_water.glsl, particle_lens.glsl; lamps.glsl with LAMPS; four vertices for each instance, a record of PARTICLE.
// The radiance J is rho (E_sun + 2 E_down + 2 E_up + sum of E_lamp): physical/particle_pass.py.
#include "frame.glsl"
#include "optics.glsl"
#include "open_water.glsl"
#include "particle_lens.glsl"
#ifdef LAMPS
#include "lamps.glsl"
uniform sampler2DShadow lamp_maps;
#endif
uniform sampler2D surface_image;
in vec4 place;   // xyz: camera frame [m]; w: radius [m]
in vec4 extent;  // xyz: motion during the exposure and own length, camera frame [m]; w: share that is drawn
in vec2 traits;  // x: reflectance; y: kind
flat out vec4 v_light;   // rgb: light; a: range [m]
flat out vec4 v_shape;   // x, y: half the length and the width [px]; z: coverage; w: kind
noperspective out vec2 v_offset;  // along and across the streak [px]

vec2 pixel_of(vec3 point) {
    vec2 slope = point.xy / max(-point.z, 0.01) - ray_first.xy;
    float row = slope.y / ray_row.y;
    return vec2((slope.x - row * ray_row.x) / ray_column.x, row);
}

vec3 lit(vec3 point) {
    float z = max(-(dot(point, up.xyz) + up.w), 0.0);
    vec3 total = daylight_total.rgb * exp(daylight_loss.rgb * -z);
    vec3 level = min(sun_beam.rgb * exp(sun_loss.rgb * -z), total);
    vec3 sum = level / upwelling.w + 2.0 * (total - level) + 2.0 * upwelling.rgb * total;
#ifdef LAMPS
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - point;
        float distance = max(length(towards), 0.03);
        float cosine = dot(lamp_axis[i].xyz, towards) / distance;
        float cone = clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
        float share = 1.0;
        if (lamp_position[i].w > -1.0) {
            vec4 uv = lamp_from_camera[i] * vec4(point, 1.0);
            share = cone > 0.0 ? textureLod(lamp_maps, uv.xyz / uv.w, 0.0) : 0.0;
        } else {
            cone = 1.0;
        }
        vec3 energy = lamp_optics[i].x - lamp_optics[i].y * sqrt(absorption.rgb * (2.0 * distance));
        vec3 transmission = exp((absorption.rgb + scattering.rgb * (1.0 - energy)) * -distance);
        sum += lamp_light[i].rgb * transmission * (cone * cone * (3.0 - 2.0 * cone) * share / (distance * distance));
    }
#endif
    return sum;
}

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    float range = length(place.xyz);
    float depth = max(-place.z, 0.01);
    vec2 first = pixel_of(place.xyz - 0.5 * extent.xyz);
    vec2 last = pixel_of(place.xyz + 0.5 * extent.xyz);
    vec2 streak = last - first;
    float streak_length = min(length(streak), 0.5 * size.x);
    vec2 along = streak_length > 0.01 ? normalize(streak) : vec2(1.0, 0.0);
    float focal = inversesqrt(abs(ray_column.x * ray_row.y));
    float radius = place.w * focal / depth;
    float blur = particle_lens.x * focal * abs(1.0 / depth - particle_lens.y);
    float drawn = max(1.7320508 * sqrt(radius * radius + blur * blur), particle_lens.z);
    float coverage = extent.w * radius * radius / (drawn * (drawn + 0.5 * streak_length));
    vec2 corner = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID % 4 < 2 ? -1.0 : 1.0);
    v_offset = corner * vec2(0.5 * streak_length + drawn, drawn);
    vec3 direct = exp((absorption.rgb + scattering.rgb) * -range);
    vec3 water = open_water(0.5 * (first + last), size);
    v_light = vec4(direct * (traits.x * lit(place.xyz) - water), range);
    v_shape = vec4(0.5 * streak_length + drawn, drawn, coverage, traits.y);
    vec2 pixel = 0.5 * (first + last) + v_offset.x * along + v_offset.y * vec2(-along.y, along.x);
    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);
}
`;var yf=`// Provides: the block ParticleLens, the lens through which particles are seen.
// Needs: nothing. Filled by physical/particle_pass.py, where the same members are declared.
// A lens with the aperture A, focused at the distance F, blurs a point at r by A |1/r - 1/F|.
layout(std140) uniform ParticleLens {
    vec4 particle_lens;  // x: radius of the aperture [m]; y: 1 / distance of the focus [1/m]; z: least radius of an image [px]
};
`;var bf=`// Provides: the image of surfaces, radiance and range in water, without the water's surface: bodies, and the sky above it.
// Needs: optics.glsl, surface_block.glsl, waves.glsl, sky.glsl; the image of the surfaces, whose alpha is the whole range.
// Pixels that begin in air have the range 0 in water; the sea is drawn before, by water_surface.frag.glsl.
#include "optics.glsl"
#include "surface_block.glsl"
#include "waves.glsl"
#include "sky.glsl"
uniform sampler2D surface_image;
out vec4 light_out;

void main() {
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    vec3 ray = mat3(world_from_ray) * (ray_first.xyz + gl_FragCoord.x * ray_column.xyz + gl_FragCoord.y * ray_row.xyz);
    float height = eye.x + eye.y * ray.z;
#ifdef WAVES
    float variance;
    if (abs(height) < bounds.x) height -= waves_at(eye.y * ray.xy, 0.0, variance).x;
#endif
    light_out = texel;
    if (height <= 0.0) return;
    vec3 direction = normalize(ray);
    bool is_body = texel.a < 0.5 * FAR;
    vec3 light = sky_in(is_body ? vec3(direction.xy, -1.0) : direction);
    light = is_body ? mix(light, texel.rgb, exp(-air.x * texel.a)) : light + sun_in(direction, 0.0);
    light_out = vec4(light, 0.0);
}
`;var wf=`// Provides: foam_cover(fall, place, footprint), the share of a pixel that foam covers; fall is the downward acceleration over gravity.
// Needs: the place in W [m], which may jump by FOAM_EDGE; the length of a pixel on the surface [m].
// Crests foam from an acceleration of 0.35 g on. Foam is lace: borders of irregular cells of two sizes, which hold longest, so
// that it dissolves towards its edges. The cells are fixed in W, as water is while waves pass. See surface/surface_pass.py.
const float FOAM_EDGE = 26.5;   // 5 tiles of ripples
const float FOAM_START = 0.24;  // acceleration at which single threads of foam are left
const float FOAM_END = 0.62;    // acceleration at which foam covers all

vec2 scatter(ivec2 cell) {
    uint n = uint(cell.x) * 1664525u + uint(cell.y) * 22695477u + 1013904223u;
    n = (n ^ (n >> 15)) * 2246822519u;
    n = (n ^ (n >> 13)) * 3266489917u;
    n ^= n >> 16;
    return vec2(float(n & 65535u), float(n >> 16)) / 65535.0;
}

// The difference of the distances to the two nearest points of an irregular lattice: 0 on borders of cells, about 1 in them.
float cell_depth(vec2 place, int n_cells) {
    vec2 first = floor(place);
    vec2 part = place - first;
    float nearest = 8.0;
    float second = 8.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 step = ivec2(i % 3, i / 3) - 1;
        ivec2 cell = (ivec2(first) + step + n_cells) % n_cells;
        vec2 apart = vec2(step) + scatter(cell) - part;
        float squared = dot(apart, apart);
        second = min(second, max(nearest, squared));
        nearest = min(nearest, squared);
    }
    return sqrt(second) - sqrt(nearest);
}

// Even noise of 0 to 1 with the size of a cell.
float soft_noise(vec2 place, int n_cells) {
    vec2 first = floor(place);
    vec2 part = place - first;
    part *= part * (3.0 - 2.0 * part);
    ivec2 cell = (ivec2(first) + n_cells) % n_cells;
    ivec2 other = (cell + 1) % n_cells;
    float low = mix(scatter(cell).x, scatter(ivec2(other.x, cell.y)).x, part.x);
    float high = mix(scatter(ivec2(cell.x, other.y)).x, scatter(other).x, part.x);
    return mix(low, high, part.y);
}

float foam_cover(float fall, vec2 place, float footprint) {
    if (fall < FOAM_START - 0.08) return 0.0;
    vec2 share = place / FOAM_EDGE;
    vec2 bend = vec2(soft_noise(share * 40.0, 40), soft_noise(share * 40.0 + 17.3, 40)) - 0.5;
    float patch_level = soft_noise(share * 23.0 + 0.35 * bend, 23);
    float dense = clamp((fall + 0.16 * (patch_level - 0.5) - FOAM_START) / (FOAM_END - FOAM_START), 0.0, 1.0);
    if (dense <= 0.0) return 0.0;
    vec2 small_bend = vec2(soft_noise(share * 170.0, 170), soft_noise(share * 170.0 + 51.7, 170)) - 0.5;
    float wide = cell_depth(share * 70.0 + 1.3 * bend + 0.5 * small_bend, 70);
    float fine = cell_depth(share * 260.0 + 2.0 * bend + 1.5 * small_bend, 260);
    float torn = soft_noise(share * 110.0 - 0.8 * bend, 110);
    float lace = 1.0 - clamp(0.55 * wide + 0.45 * fine + 0.55 * torn - 0.1, 0.0, 1.0);
    float blur = 0.22 + smoothstep(0.1, 0.6, footprint);
    float cover = smoothstep(-blur, blur, lace - 1.0 + 1.4 * dense);
    return cover * smoothstep(0.0, 0.25, dense);
}
`;var xf=`// Provides: reflectance(cosine, sine_ratio), the share of unpolarised light that the surface reflects.
// Needs: nothing; cosine of incidence; sine_ratio = sine of refraction over sine of incidence: 1 / n from air, n from water.
// 1 where the light is totally reflected.
float reflectance(float cosine, float sine_ratio) {
    float squared = 1.0 - sine_ratio * sine_ratio * (1.0 - cosine * cosine);
    if (squared <= 0.0) return 1.0;
    float refracted = sqrt(squared);
    float s = (sine_ratio * cosine - refracted) / (sine_ratio * cosine + refracted);
    float p = (cosine - sine_ratio * refracted) / (cosine + sine_ratio * refracted);
    return 0.5 * (s * s + p * p);
}
`;var Ef=`// Provides: sky_in(direction), the sky without the sun; sun_in(direction, variance); water_in(direction).
// Needs: surface_block.glsl; the hemispheres of surface/hemispheres.py. Directions are unit vectors in W.
// sun_in: the sun's image with a blur of that variance along each axis [rad2]; water_in: the open water below the surface.
uniform sampler2DArray hemispheres;

vec3 hemisphere(vec3 direction, float layer) {
    vec2 place = direction.xy / (1.0 + max(direction.z, 0.0));
    float size = float(textureSize(hemispheres, 0).x);
    return textureLod(hemispheres, vec3((place * (size - 1.0) / size) * 0.5 + 0.5, layer), 0.0).rgb;
}

vec3 sky_in(vec3 direction) {
    return hemisphere(direction.z < 0.0 ? vec3(direction.xy * inversesqrt(max(dot(direction.xy, direction.xy), 1e-12)), 0.0) : direction, 0.0);
}

vec3 water_in(vec3 direction) {
    return hemisphere(vec3(direction.xy, -direction.z), 1.0);
}

vec3 sun_in(vec3 direction, float variance) {
    float total = variance + 0.25 * sky_sun.w * sky_sun.w + 0.25 * air.z * air.z;
    vec3 apart = direction - sky_sun.xyz;
    return sky_sun_light.rgb * (0.5 / total * exp(-0.5 * dot(apart, apart) / total));
}
`;var Af=`// Provides: skylight(normal, share), the light of sun and sky on a surface in air, and of the sea below it.
// Needs: surface_block.glsl; the unit normal in the camera frame; share = 0 in the sun's shadow to 1.
// The sky and the sea count as even; the sea reflects 6 % of the light.
vec3 skylight(vec3 normal, float share) {
    vec3 upright = mat3(world_from_ray) * normal;
    vec3 level = sky_light.rgb + sky_sun_light.rgb * sky_sun.z;
    return sky_sun_light.rgb * (max(dot(upright, sky_sun.xyz), 0.0) * share)
        + sky_light.rgb * (0.5 + 0.5 * upright.z) + level * (0.03 - 0.03 * upright.z);
}
`;var Sf=`// Provides: the block Surface, the numbers of the water's surface, the sky and the air.
// Needs: nothing. Filled by surface/surface_block.py, where the same members are declared.
// Offsets are positions in W minus that of the camera [m].
layout(std140) uniform Surface {
    mat4 clip_from_offset;
    mat4 world_from_ray;   // rotation: W from the camera frame (OpenGL axes)
    vec4 eye;              // x: height of the camera above the still surface [m]; y: near plane [m]; w: number of grids
    vec4[4] grids;         // for each grid: xy: texture coordinates of the camera; z: 1 / edge [1/m]; w: spacing [m]
    vec4 roughness;        // variance of the slopes that each grid leaves out
    vec4 ripples;          // x: factor on the slopes of a tile; y: their variance; z: 1 / edge of the tile [1/m]; w: its spacing [m]
    vec4 ripple_origin;    // xy: camera in the tile [m]
    vec4 ripple_turn;      // xy: camera in the turned, smaller tile [m]; zw: cosine and sine of its turn over its size
    vec4 bounds;           // x: greatest elevation of waves [m]; y: variance of their slopes along one axis
    vec4 sky_sun;          // xyz: towards the sun above the water, W; w: its angular radius [rad]
    vec4 sky_sun_light;    // rgb: irradiance of a surface that faces the sun; w: cosine of the refracted sun from the zenith
    vec4 sky_light;        // rgb: irradiance of a level surface by the sky
    vec4 water_light;      // rgb: radiance of the open water from below the surface, even
    vec4 image_size;       // xy: width and height [px]
    vec4 air;              // x: attenuation of air [1/m]; y: refractive index of water; z: angle of a pixel [rad]
};
`;var Mf=`// Provides: numbers of the block Surface as flat varyings; VARYING is \`out\` in the vertex shader, \`in\` in the fragment shader.
// Needs: surface_block.glsl; the switches WAVES, RIPPLES and FOAM. In the fragment shader, include it before waves.glsl and sky.glsl:
// their names of members of the block then are these varyings. llvmpipe reads them much faster than uniforms in each pixel.
flat VARYING vec4 v_air;
flat VARYING vec4 v_sky_sun;
flat VARYING vec4 v_sky_sun_light;
flat VARYING vec4 v_water_light;
flat VARYING vec4 v_numbers;  // x: height of the camera above the still surface [m]; yz: width and height of the image [px]
flat VARYING vec3[3] v_clip;  // the rows x, y and w of clip_from_offset
#if defined(WAVES) && WAVES == 1
flat VARYING vec4[1] v_grids;
flat VARYING vec4 v_roughness;
#endif
#ifdef RIPPLES
flat VARYING vec4 v_ripples;
flat VARYING vec4 v_ripple_origin;
flat VARYING vec4 v_ripple_turn;
#endif
#ifdef FOAM
flat VARYING vec4 v_sky_light;
#endif
#ifdef READS_VARYINGS
#define air v_air
#define sky_sun v_sky_sun
#define sky_sun_light v_sky_sun_light
#define water_light v_water_light
#if defined(WAVES) && WAVES == 1
#define grids v_grids
#define roughness v_roughness
#endif
#define ripples v_ripples
#define ripple_origin v_ripple_origin
#define ripple_turn v_ripple_turn
#define sky_light v_sky_light
#else
void pass_on_surface() {
    v_air = air;
    v_sky_sun = sky_sun;
    v_sky_sun_light = sky_sun_light;
    v_water_light = water_light;
    v_numbers = vec4(eye.x, image_size.xy, 0.0);
    v_clip[0] = vec3(clip_from_offset[0].x, clip_from_offset[1].x, clip_from_offset[2].x);
    v_clip[1] = vec3(clip_from_offset[0].y, clip_from_offset[1].y, clip_from_offset[2].y);
    v_clip[2] = vec3(clip_from_offset[0].w, clip_from_offset[1].w, clip_from_offset[2].w);
#if defined(WAVES) && WAVES == 1
    v_grids[0] = grids[0];
    v_roughness = roughness;
#endif
#ifdef RIPPLES
    v_ripples = ripples;
    v_ripple_origin = ripple_origin;
    v_ripple_turn = ripple_turn;
#endif
#ifdef FOAM
    v_sky_light = sky_light;
#endif
}
#endif
`;var Tf=`// Provides: the radiance and the range in water of the water's surface, from below, or with the switch ABOVE from above.
// Needs: optics.glsl, surface_block.glsl, surface_varyings.glsl, waves.glsl, sky.glsl, fresnel.glsl, foam.glsl; transmission.glsl from above and for MIRROR;
// without the switch DIRECT, the image of the surfaces, whose alpha is the whole range; the switch MIRROR for the image of bodies that a still surface mirrors,
// or BODIES_ABOVE to look for them in the picture.
// From below: sky refracted, open water and bodies reflected; the water before it follows in whole images (physical/development.py), which
// takes the open water B behind it away. From above: sky reflected, the water and the bodies in it refracted. See surface_pass.py.
#include "optics.glsl"
#include "surface_block.glsl"
#define VARYING in
#define READS_VARYINGS
#include "surface_varyings.glsl"
#include "waves.glsl"
#include "sky.glsl"
#include "fresnel.glsl"
#if defined(ABOVE) || defined(MIRROR)
#include "transmission.glsl"
#endif
#ifndef DIRECT
uniform sampler2D surface_image;
#endif
in vec3 v_offset;
#ifdef ABOVE
in vec4 v_haze;
in vec3 v_water;
#else
in vec3 v_open_water;
#endif
#if defined(WAVES) && WAVES > 1
flat in vec4 v_finer;
flat in vec4 v_coarser;
flat in ivec2 v_layers;
in float v_level;
#endif
#ifdef RIPPLES
in vec3 v_fades;
#endif
out vec4 light_out;
const float PI = 3.14159265;
#ifdef FOAM
#include "foam.glsl"
#endif

vec3 clip_of(vec3 offset) {
    return vec3(dot(v_clip[0], offset), dot(v_clip[1], offset), dot(v_clip[2], offset));
}

vec2 place_of(vec3 clip) {
    return clip.xy / max(clip.z, 1e-3) * 0.5 + 0.5;
}

#ifdef MIRROR
uniform sampler2D mirror_image;

vec4 mirror_texel(vec2 place) {
    vec2 size = vec2(textureSize(mirror_image, 0));
    return texelFetch(mirror_image, ivec2(clamp(vec2(place.x, 1.0 - place.y) * size, vec2(0.0), size - 1.0)), 0);
}

// The body that a reflected ray meets, or FAR: its radiance and the way to it. The image is that of a still surface
// (surface/mirror_view.py); the way to the body there, or to one near by, is that along the ray.
vec4 mirrored_body(vec3 direction, float range) {
    vec2 here = gl_FragCoord.xy / v_numbers.yz;
    float way = mirror_texel(here).a - range;
    way = way < 0.5 * FAR ? max(way, 0.1) : 6.0;
    vec3 point = v_offset + way * direction;
    vec2 place = place_of(clip_of(vec3(point.xy, -2.0 * v_numbers.x - point.z)));
    vec4 seen = mirror_texel(place);
    seen.a = seen.a < 0.5 * FAR ? max(seen.a - range, 0.1) : FAR;
    return seen;
}
#endif

#if defined(ABOVE) && defined(BODIES_ABOVE)
// Follow a reflected ray within the picture to a body above the still surface: six distances, each 2.2 times the one before,
// then two halvings. Return its radiance and the way to it, or FAR.
vec4 followed_body(vec3 direction, float range) {
    vec3 here = clip_of(v_offset);
    vec3 change = clip_of(direction);
    float first = 0.0;
    float way = 0.25 / max(abs(direction.z), 0.1);
    float met = FAR;
    ivec2 pixel = ivec2(0);
    for (int i = 0; i < 8; ++i) {
        vec3 clip = here + way * change;
        vec2 place = clip.xy / clip.z * 0.5 + 0.5;
        if (clip.z <= 0.0 || place != clamp(place, 0.0, 1.0)) break;  // it does not come back
        ivec2 there = ivec2(clamp(place, 0.0, 0.9999) * v_numbers.yz);
        float body_range = texelFetch(surface_image, there, 0).a;
        vec3 offset = v_offset + way * direction;
        float distance = length(offset);
        bool is_seen = body_range < distance && body_range > distance - max(way, 1.0) && v_numbers.x + offset.z * body_range / distance > 0.0;
        if (is_seen) {
            met = way;
            pixel = there;
        }
        if (met < FAR) {
            if (!is_seen) first = way;
            way = 0.5 * (first + met);
            if (i >= 7) break;
        } else {
            first = way;
            if (i >= 5) break;
            way *= 2.2;
        }
    }
    return vec4(met < FAR ? texelFetch(surface_image, pixel, 0).rgb : vec3(0.0), met);
}
#endif

#ifdef ABOVE
// The body that a refracted ray meets, or FAR: its radiance and the way to it. It is looked for at the depth of the
// body behind the surface, then where the body found there is. Hidden bodies are replaced by that behind the surface.
vec4 refracted_body(vec3 direction, vec3 towards, float range, vec4 straight) {
    vec3 here = clip_of(v_offset);
    vec3 change = clip_of(direction);
    float steep = max(-direction.z, 0.2);
    bool has_straight = straight.a < 0.5 * FAR;
    float way = has_straight ? max(straight.a - range, 0.0) * max(-towards.z, 0.0) / steep : 3.0;
    vec4 seen = vec4(straight.rgb, has_straight ? way : FAR);
    for (int i = 0; i < 2; ++i) {
        vec2 place = place_of(here + way * change);
        vec4 body = texelFetch(surface_image, ivec2(clamp(place, 0.0, 0.9999) * v_numbers.yz), 0);
        vec3 point = v_offset + way * direction;
        float distance = length(point);
        float height = point.z / distance;
        if (body.a < range || body.a > 0.5 * FAR || v_numbers.x + height * body.a > 0.0) break;
        way = max(way + (body.a - distance) * max(-height, 0.05) / steep, 0.0);
        // Towards the edges of the picture, outside of which nothing is known, the body behind the surface replaces it.
        vec2 inside = min(place, 1.0 - place);
        float known = has_straight ? clamp(12.0 * min(inside.x, inside.y), 0.0, 1.0) : 1.0;
        seen = vec4(mix(straight.rgb, body.rgb, known), way);
    }
    return seen;
}

vec3 light_above(vec3 towards, float range, vec3 normal, float variance, vec4 straight) {
    float cosine = max(-dot(towards, normal), 0.0);
    float share = reflectance(sqrt(min(cosine * cosine + 0.5 * variance, 1.0)), 1.0 / air.y);
    vec3 mirrored = reflect(towards, normal);
    mirrored = normalize(vec3(mirrored.xy, abs(mirrored.z) + 0.5 * sqrt(variance)));
    vec3 above = sky_in(mirrored);
#if defined(MIRROR) || defined(BODIES_ABOVE)
#ifdef MIRROR
    vec4 reflected = mirrored_body(mirrored, range);
#else
    vec4 reflected = followed_body(mirrored, range);
#endif
    if (reflected.a < 0.5 * FAR) above = reflected.rgb;
#endif
    vec3 light = share * above;
    vec3 half_way = normalize(sky_sun.xyz - towards);
    float steep = max(half_way.z, 0.05);
    float spread = variance + 0.0625 * sky_sun.w * sky_sun.w + 0.0625 * air.z * air.z;
    vec2 apart = half_way.xy / -steep - normal.xy / -normal.z;
    float facets = exp(-0.5 * dot(apart, apart) / spread) / (2.0 * PI * spread);
    float glint = reflectance(max(-dot(half_way, towards), 0.0), 1.0 / air.y) * PI * facets;
    light += sky_sun_light.rgb * (glint / (4.0 * max(cosine, 0.05) * steep * steep * steep * steep));
    vec3 refracted = refract(towards, normal, 1.0 / air.y);
    vec3 below = v_water;
    vec4 body = refracted_body(refracted, towards, range, straight);
    if (body.a < 0.5 * FAR) below = mix(below, body.rgb, whole_field(body.a));
    return light + (1.0 - share) / (air.y * air.y) * below;
}

#else
// In the window the open water that is reflected counts as even, so one look-up is enough.
vec3 light_below(vec3 towards, float range, vec3 normal, float variance) {
    float cosine = clamp(dot(towards, normal), 1e-3, 1.0);
    float share = reflectance(cosine, air.y);
    vec3 refracted = refract(towards, -normal, air.y);
    vec3 mirrored = reflect(towards, normal);
    bool is_window = share < 1.0;
    vec3 direction = is_window ? vec3(refracted.xy, max(refracted.z, 0.0)) : vec3(mirrored.xy, abs(mirrored.z));
    vec3 light = hemisphere(direction, is_window ? 0.0 : 1.0);
    if (!is_window) {
#ifdef MIRROR
        vec4 body = mirrored_body(vec3(mirrored.xy, -abs(mirrored.z)), range);
        if (body.a < 0.5 * FAR) light = mix(light, body.rgb, whole_field(body.a));
#endif
        return light;
    }
    float slant = dot(refracted, normal);
    float turn = (air.y * cosine - slant) / max(slant, 0.15);
    light += sun_in(refracted, turn * turn * variance + 0.5 * air.z * air.z);
    return (1.0 - share) * air.y * air.y * light + share * water_light.rgb;
}
#endif

// Elevation [m], slopes along x and y, downward acceleration over gravity; variance of the slopes that are left out.
vec4 waves_here(out float variance) {
#if defined(WAVES) && WAVES > 1
    float share = smoothstep(0.5, 1.0, v_level - float(v_layers.x < 0 ? WAVES : v_layers.x));
    variance = mix(v_finer.w, v_coarser.w, share);
    vec4 wave = vec4(0.0);
    if (v_layers.x >= 0) wave = (1.0 - share) * textureLod(wave_grids, vec3(v_finer.xy + v_offset.xy * v_finer.z, float(v_layers.x)), 0.0);
    if (share > 0.0 && v_layers.y >= 0) wave += share * textureLod(wave_grids, vec3(v_coarser.xy + v_offset.xy * v_coarser.z, float(v_layers.y)), 0.0);
    return wave;
#else
    return waves_at(v_offset.xy, 0.0, variance);
#endif
}

void main() {
    float range = length(v_offset);
#ifndef DIRECT
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    if (texel.a < range) discard;
#endif
    vec3 towards = v_offset / range;
    float variance;
    vec4 wave = waves_here(variance);
    vec2 slope = wave.yz;
#ifdef RIPPLES
    if (v_fades.x > 0.0) slope += ripples_at(v_offset.xy, v_fades.xy);
    variance += v_fades.z;
#endif
    vec3 normal = normalize(vec3(-slope, 1.0));
#ifdef FOAM
#ifdef RIPPLES
    vec2 foam_place = ripple_origin.xy + v_offset.xy;
#else
    vec2 foam_place = v_offset.xy;
#endif
    float foam = 0.9 * foam_cover(wave.w, foam_place, range * air.z / clamp(abs(towards.z), 0.02, 1.0));
    vec3 lit = sky_light.rgb + sky_sun_light.rgb * max(dot(normal, sky_sun.xyz), 0.0);
#endif
#ifdef ABOVE
    vec3 light = light_above(towards, range, normal, variance, texel);
#ifdef FOAM
    light = mix(light, (0.3 + 0.25 * foam) * lit, foam);  // thick foam is whiter than thin foam
#endif
    light_out = vec4(mix(v_haze.rgb, light, v_haze.a), 0.0);
#else
    vec3 light = light_below(towards, range, normal, variance);
#ifdef FOAM
    light = mix(light, 0.3 * lit, foam);
#endif
    light_out = vec4(light + v_open_water, range);
#endif
}
`;var Rf=`// Provides: the water's surface around the camera, raised by the waves.
// Needs: surface_block.glsl, surface_varyings.glsl, waves.glsl, open_water.glsl without the switch ABOVE, sky.glsl with it; vertices are offsets from the camera in the horizontal plane of W [m].
// The far plane is at infinity; with the switch DIRECT it is that of the camera.
#include "surface_block.glsl"
#define VARYING out
#include "surface_varyings.glsl"
#include "waves.glsl"
#ifndef ABOVE
#include "open_water.glsl"
out vec3 v_open_water;  // behind the surface; even enough to be interpolated
#endif
#ifdef ABOVE
#include "sky.glsl"
out vec4 v_haze;   // rgb: the sky at the horizon behind the air; a: the share of light that air leaves
out vec3 v_water;  // open water below the surface, even enough to be interpolated
#endif
in vec2 vertex;
out vec3 v_offset;
#if defined(WAVES) && WAVES > 1
flat out vec4 v_finer;    // xy: texture coordinates of the camera in the finer grid; z: 1 / edge [1/m]; w: its roughness
flat out vec4 v_coarser;  // those of the coarser grid
flat out ivec2 v_layers;  // their layers, or -1 for none
out float v_level;
#endif
#ifdef RIPPLES
out vec3 v_fades;  // xy: factors on the slopes of ripples; z: variance of the slopes that are left out
#endif

void main() {
    pass_on_surface();
    float variance;
    vec4 wave = waves_at(vertex, 0.0, variance);
    v_offset = vec3(vertex, wave.x - eye.x);
    gl_Position = clip_from_offset * vec4(v_offset, 1.0);
    vec3 towards = normalize(v_offset);
    // the face of a wave may be seen at a smaller angle than the still surface
    float incidence = min(abs(dot(towards, normalize(vec3(-wave.yz, 1.0)))), max(abs(towards.z), 0.02));
    float footprint = length(v_offset) * air.z / clamp(incidence, 0.02, 1.0);
#if defined(WAVES) && WAVES > 1
    v_level = grid_level(vertex, footprint);
    int finer = int(v_level);
    v_layers = ivec2(finer < WAVES ? finer : -1, finer + 1 < WAVES ? finer + 1 : -1);
    v_finer = finer < WAVES ? vec4(grids[finer].xyz, roughness[finer]) : vec4(0.0, 0.0, 0.0, bounds.y);
    v_coarser = finer + 1 < WAVES ? vec4(grids[finer + 1].xyz, roughness[finer + 1]) : vec4(0.0, 0.0, 0.0, bounds.y);
#endif
#ifdef RIPPLES
    v_fades.z = 0.0;
    v_fades.xy = find_fades(footprint, v_fades.z);
#endif
#ifdef ABOVE
    v_haze = vec4(sky_in(vec3(towards.xy, -1.0)), exp(-air.x * length(v_offset)));
    v_water = water_in(refract(towards, vec3(0.0, 0.0, 1.0), 1.0 / air.y));
#else
    vec2 place = gl_Position.xy / max(gl_Position.w, 1e-3) * 0.5 + 0.5;
    v_open_water = open_water(clamp(place, 0.0, 1.0) * image_size.xy, image_size.xy);
#endif
#ifndef DIRECT
    gl_Position.z = gl_Position.w - 2.0 * eye.y;
#endif
}
`;var Lf=`// Provides: waves_at(offset, footprint, variance), the waves of the surface; find_fades(...) and ripples_at(...), the slopes of ripples.
// Needs: surface_block.glsl; the switches WAVES, the number of grids, and RIPPLES; the grids of surface/wave_grids.py and the tile of surface/ripples.py.
// offset: from the camera in the horizontal plane of W [m]; footprint: length of a pixel on the surface [m]; variance of the
// slopes along one axis that the pixel does not resolve. Finer grids go over into coarser ones without a seam.
#ifdef WAVES
#if WAVES == 1
uniform sampler2D wave_grid;

vec4 grid_at(int level, vec2 offset) {
    return textureLod(wave_grid, grids[0].xy + offset * grids[0].z, 0.0);
}
#else
uniform sampler2DArray wave_grids;

vec4 grid_at(int level, vec2 offset) {
    return textureLod(wave_grids, vec3(grids[level].xy + offset * grids[level].z, float(level)), 0.0);
}
#endif
#endif
#ifdef RIPPLES
uniform sampler2D ripple_tile;
#endif

#if defined(WAVES) && WAVES > 1
// The continuous number of the grid for a place: finer grids are near the camera and for small footprints.
float grid_level(vec2 offset, float footprint) {
    float distance = max(abs(offset.x), abs(offset.y)) * grids[0].z / 0.46;
    float coarse = 0.5 * log2(max(footprint / grids[0].w, 1e-6));
    return max(max(0.5 * log2(max(distance, 1e-6)) + 1.0, min(coarse, eye.w - 1.0)), 0.0);
}
#endif

// Elevation [m], slopes along x and y, downward acceleration over gravity.
vec4 waves_at(vec2 offset, float footprint, out float variance) {
    variance = 0.0;
    vec4 wave = vec4(0.0);
#if defined(WAVES) && WAVES == 1
    variance = roughness[0];
    wave = grid_at(0, offset);
#elif defined(WAVES)
    float level = grid_level(offset, footprint);
    float share = smoothstep(0.5, 1.0, fract(level));
    int finer = int(level);
    int n = int(eye.w);
    variance = bounds.y;
    if (finer < n) {
        wave = grid_at(finer, offset);
        variance = roughness[finer];
    }
    if (share > 0.0) {
        wave *= 1.0 - share;
        variance *= 1.0 - share;
        if (finer + 1 < n) {
            wave += share * grid_at(finer + 1, offset);
            variance += share * roughness[finer + 1];
        } else {
            variance += share * bounds.y;
        }
    }
#endif
    return wave;
}

#ifdef RIPPLES
float tile_fade(float footprint, inout float variance) {
    float fade = 1.0 - smoothstep(2.0, 10.0, footprint / ripples.w);
    variance += ripples.y * (1.0 - fade * fade);
    return ripples.x * fade;
}

// The factors on the slopes of both uses of the tile, at most 1.
vec2 find_fades(float footprint, inout float variance) {
    float stretch = length(ripple_turn.zw);
    float fade = tile_fade(footprint, variance);
    return vec2(fade, tile_fade(footprint * stretch, variance) / stretch);
}

vec2 ripples_at(vec2 offset, vec2 fades) {
    mat2 turn = mat2(ripple_turn.z, ripple_turn.w, -ripple_turn.w, ripple_turn.z);
    vec2 shift = vec2(0.5 / 128.0);
    vec2 slope = textureLod(ripple_tile, (ripple_origin.xy + offset) * ripples.z + shift, 0.0).yz;
    vec2 turned = textureLod(ripple_tile, (ripple_turn.xy + turn * offset) * ripples.z + shift, 0.0).yz;
    return fades.x * slope + fades.y * (transpose(turn) * turned);
}
#endif
`;var Pf=`// Provides: a finished image at its place on the page; an image twice as wide and high becomes the mean of its squares of four.
// Needs: presented.vert.glsl; the image, row 0 at the top, with linear interpolation.
in vec2 v_uv;
uniform sampler2D level_0;
out vec4 colour_out;

void main() {
    colour_out = textureLod(level_0, v_uv, 0.0);
}
`;var If=`// Provides: one triangle over the whole target, and the texture coordinates of its pixels.
// Needs: nothing; three vertices without attributes. With the switch FLIPPED, row 0 of the target is the lowest one of the image.
out vec2 v_uv;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_uv = 0.5 * corner + 0.5;
#ifdef FLIPPED
    v_uv.y = 1.0 - v_uv.y;
#endif
    gl_Position = vec4(corner, 0.0, 1.0);
}
`;var kf=`// Provides: the waves at the points of a grid: elevation [m], slopes along x and y, downward acceleration over gravity.
// Needs: screen.vert.glsl; the factors of each component at the columns and at the rows of the grid (wave_grids.ts).
uniform sampler2D factors_x;  // cosine and sine of the phase; wave number along x [rad/m]; squared frequency over gravity [1/m]
uniform sampler2D factors_y;  // amplitude [m] times cosine and sine of the change of phase; wave number along y
out vec4 grid_out;

void main() {
    ivec2 point = ivec2(gl_FragCoord.xy);
    int n = textureSize(factors_x, 0).y;
    vec4 total = vec4(0.0);
    for (int i = 0; i < n; ++i) {
        vec4 x = texelFetch(factors_x, ivec2(point.x, i), 0);
        vec4 y = texelFetch(factors_y, ivec2(point.y, i), 0);
        float height = y.x * x.x - y.y * x.y;
        float steepness = y.x * x.y + y.y * x.x;
        total += vec4(height, -x.z * steepness, -y.z * steepness, x.w * height);
    }
    grid_out = total;
}
`;var pv={"background.frag.glsl":Sc,"background.vert.glsl":Mc,"blur_weight.glsl":Tc,"blurred.frag.glsl":Rc,"blurred_rows.frag.glsl":Lc,"blurred.vert.glsl":Pc,"caustics.glsl":Ic,"caustics_block.glsl":kc,"cloud.frag.glsl":Cc,"cloud.vert.glsl":Oc,"cloud_edge.glsl":Nc,"clouds.glsl":Dc,"daylight.glsl":Fc,"developed.frag.glsl":Vc,"developed.vert.glsl":Uc,"frame.glsl":Gc,"gaussian.glsl":zc,"grey.glsl":Bc,"instance.glsl":Wc,"lamp_point.frag.glsl":Hc,"lamp_point.vert.glsl":Yc,"lamp_veil.glsl":qc,"lamplight.glsl":Xc,"lamps.glsl":jc,"light_shafts.frag.glsl":$c,"material.glsl":Kc,"open_water.glsl":Qc,"optics.glsl":Jc,"particle.frag.glsl":gf,"particle.vert.glsl":_f,"particle_lens.glsl":yf,"presented.frag.glsl":Pf,"presented.vert.glsl":If,"projection.glsl":Zc,"projector.glsl":ef,"reduced.frag.glsl":tf,"scattered.frag.glsl":rf,"scattered.vert.glsl":sf,"screen.vert.glsl":nf,"shadow.frag.glsl":af,"shadow.glsl":of,"shadow.vert.glsl":lf,"sun.glsl":cf,"surface.frag.glsl":ff,"surface.vert.glsl":uf,"targets.glsl":hf,"transmission.glsl":df,"varyings.glsl":mf,"veil_varyings.glsl":pf,"water.glsl":vf,"air.frag.glsl":bf,"foam.glsl":wf,"fresnel.glsl":xf,"sky.glsl":Ef,"skylight.glsl":Af,"surface_block.glsl":Sf,"surface_varyings.glsl":Mf,"water_surface.frag.glsl":Tf,"water_surface.vert.glsl":Rf,"waves.glsl":Lf,"wave_grid.frag.glsl":kf},vv=`#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp sampler2DShadow;
#define noperspective
`,$t={Frame:0,Instance:1,Lamps:2,Projector:3,Optics:4,Caustics:5,Surface:7,ParticleLens:9,Clouds:10},Q={base_map:0,shadow_map:1,lamp_maps:2,projector_map:3,projector_pattern:4,open_water_map:5,weight_table:6,level_0:7,level_1:8,level_2:9,level_3:10,level_4:15,level_5:16,surface_image:17,normal_map:11,finish_map:12,emission_map:13,reflectance_table:14,particle_image:18,wave_grids:19,wave_grid:20,ripple_tile:21,hemispheres:22,factors_x:23,factors_y:24,cloud_layers_map:25,cloud_lamplight_map:26,cloud_daylight_map:27,caustic_maps:28,swell_map:29,shaft_image:30,mirror_image:31},Ft={vertex:0,vertex_normal:1,uv:2,tint:3,tangent:4,finish:5,emission:6,place:8,extent:9,traits:10,depth:11},Pi=class{constructor(e){this.gl=e}gl;programs=new Map;get(e,t,r=e){let i=e+JSON.stringify(t),n=this.programs.get(i);return n||this.programs.set(i,n=gv(this.gl,e,t,r)),n}};function Ff(s,e){if(e.has(s))return"";e.add(s);let t=pv[s];return t===void 0?`#error no shader file ${s}`:t.replace(/^#include "([\w.]+)"$/gm,(r,i)=>Ff(i,e))}function gv(s,e,t,r){let i=Object.entries(t).map(([a,o])=>`#define ${a} ${o}
`),n=s.createProgram();for(let[a,o]of[[s.VERTEX_SHADER,`${r}.vert.glsl`],[s.FRAGMENT_SHADER,`${e}.frag.glsl`]]){let l=s.createShader(a);s.shaderSource(l,vv+i.join("")+Ff(o,new Set)),s.compileShader(l),s.attachShader(n,l)}for(let[a,o]of Object.entries(Ft))s.bindAttribLocation(n,o,a);if(s.linkProgram(n),!s.getProgramParameter(n,s.LINK_STATUS)){let a=(s.getAttachedShaders(n)??[]).map(o=>s.getShaderInfoLog(o));throw new Error(`${e}: ${s.getProgramInfoLog(n)} ${a.join(" ")}`)}s.useProgram(n);for(let[a,o]of Object.entries($t)){let l=s.getUniformBlockIndex(n,a);l!==s.INVALID_INDEX&&s.uniformBlockBinding(n,l,o)}for(let[a,o]of Object.entries(Q))s.uniform1i(s.getUniformLocation(n,a),o);return n}var Cf={normal_map:"NORMAL_MAP",finish_map:"FINISH_MAP",emission_map:"EMISSION_MAP"},Of=32,_v=[["tangent","tangents",4,"SHORT"],["finish","finish",3,"FLOAT"],["emission","emissions",3,"FLOAT"]];function yv(s,e,t){let r={};return"normal_map"in s.maps&&(r.NORMAL_MAP=1),e&&(r.MICROFACET=1,"finish_map"in s.maps&&(r.FINISH_MAP=1),s.emits&&(r.EMISSION=1),s.emits&&"emission_map"in s.maps&&(r.EMISSION_MAP=1)),t&&Object.assign(r,Aa(s)),r}function Aa(s){return!s||s.cutoff===null?{}:{ALPHA_TEST:Math.max(1,Math.min(255,Math.round(255*s.cutoff)))}}function Nf(s,e){for(let[t,r,i,n]of _v){let a=s[r];a&&e(t,i,n,a)}}var Ii=class{constructor(e,t,r,i){this.gl=e;this.images=r;this.textures=i;this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(a=>{let o=e.createSampler();return e.samplerParameteri(o,e.TEXTURE_MIN_FILTER,e.LINEAR_MIPMAP_NEAREST),e.samplerParameteri(o,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(o,e.TEXTURE_WRAP_S,a),e.samplerParameteri(o,e.TEXTURE_WRAP_T,a),o});let{reflectance:n}=t.head;this.table=n?bv(e,t.numbers(n)):null}gl;images;textures;samplers;table;use(e,t,r){if(!e)return t;let i=this.gl,n={...t,...yv(e,"PHYSICAL"in t,"TEXTURED"in t)};for(let[a,o]of Object.entries(e.maps)){if(!(Cf[a]in n))continue;let l=Number(this.textures[o].repeats);this.bindTexture(Q[a],this.images[o]),i.bindSampler(Q[a],(r??this.samplers)[l])}return n.MICROFACET&&this.table&&this.bindTexture(Q.reflectance_table,this.table),n}baseSamplers(e){return"NORMAL_MAP"in e&&!("PHYSICAL"in e||"ALPHA_TEST"in e)?this.samplers:null}release(){for(let e of Object.keys(Cf))this.gl.bindSampler(Q[e],null)}bindTexture(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}};function bv(s,e){let t=s.createTexture();s.bindTexture(s.TEXTURE_2D,t),s.texImage2D(s.TEXTURE_2D,0,s.RGBA16F,Of,Of,0,s.RGBA,s.FLOAT,e);for(let r of[s.TEXTURE_WRAP_S,s.TEXTURE_WRAP_T])s.texParameteri(s.TEXTURE_2D,r,s.CLAMP_TO_EDGE);for(let r of[s.TEXTURE_MIN_FILTER,s.TEXTURE_MAG_FILTER])s.texParameteri(s.TEXTURE_2D,r,s.LINEAR);return t}function Df(s,e,t){let r=e.head.meshes[t],i=s.createVertexArray();s.bindVertexArray(i);let n=(c,h,f,d)=>{let p=s.createBuffer();return s.bindBuffer(s.ARRAY_BUFFER,p),s.bufferData(s.ARRAY_BUFFER,d,s.STATIC_DRAW),s.enableVertexAttribArray(Ft[c]),s.vertexAttribPointer(Ft[c],h,f,f!==s.FLOAT,0,0),p},a=c=>e.numbers(c),o=n("vertex",3,s.FLOAT,a(r.positions)),l=n("vertex_normal",3,s.SHORT,a(r.normals));return n("tint",3,s.UNSIGNED_SHORT,a(r.tints)),r.uvs&&n("uv",2,s.FLOAT,a(r.uvs)),Nf(r,(c,h,f,d)=>n(c,h,s[f],a(d))),s.bindBuffer(s.ELEMENT_ARRAY_BUFFER,s.createBuffer()),s.bufferData(s.ELEMENT_ARRAY_BUFFER,a(r.triangles),s.STATIC_DRAW),s.bindVertexArray(null),{vertexArray:i,positions:o,normals:l}}async function Vf(s,e,t,r){let{type:i,bytes:n,levels:a}=e.head.textures[t],o=t===e.head.projector?.pattern,l=(p,_)=>createImageBitmap(new Blob([e.numbers(p)],{type:_}),{imageOrientation:o?"from-image":"flipY",premultiplyAlpha:"none",colorSpaceConversion:"none"}),c=await l(n,i),h=await Promise.all((a??[]).map(p=>l(p,"image/webp"))),f=s.createTexture();s.bindTexture(s.TEXTURE_2D,f),s.texImage2D(s.TEXTURE_2D,0,s.RGBA8,s.RGBA,s.UNSIGNED_BYTE,c);let d=r?s.REPEAT:s.CLAMP_TO_EDGE;return s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_S,d),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_T,d),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MAG_FILTER,s.LINEAR),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MIN_FILTER,o?s.LINEAR:s.LINEAR_MIPMAP_LINEAR),a?s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MAX_LEVEL,a.length):o||s.generateMipmap(s.TEXTURE_2D),h.forEach((p,_)=>s.texImage2D(s.TEXTURE_2D,_+1,s.RGBA8,s.RGBA,s.UNSIGNED_BYTE,p)),c.close(),f}var Sa=class{constructor(e,t,r,i,n,a,o,l){this.index=e;this.visual=t;this.body=r;this.vertexArray=i;this.texture=n;this.repeats=a;this.hasUint32Indices=o;this.pieceRows=l;this.bodyFromMesh=we(t.matrix),this.pieces=l.map(([c,h])=>({instance:this,firstIndex:c,count:h,centre:[0,0,0],radius:0,corners:[],normal:[0,0,0],density:0}))}index;visual;body;vertexArray;texture;repeats;hasUint32Indices;pieceRows;pieces;worldFromMesh=we(new Array(16).fill(0));normals=this.worldFromMesh;isMirrored=!1;bodyFromMesh;isPresent=!0;place(e){let t=Ie(e,this.bodyFromMesh);if(t.every((n,a)=>n===this.worldFromMesh[a]))return!1;this.worldFromMesh=t,this.normals=xo(t),this.isMirrored=Pn(t)<0;let[r,i]=[Uf(t),Uf(this.normals)];return this.pieceRows.forEach((n,a)=>{let o=this.pieces[a];o.centre=Re(t,n.slice(2,5)),o.radius=n[5]*r;let l=[n.slice(6,9),n.slice(9,12)];o.corners=[0,1,2,3,4,5,6,7].map(h=>Re(t,[l[h>>2][0],l[h>>1&1][1],l[h&1][2]]));let c=n.slice(12,15);o.normal=le(c,c)>0?xt(Xr(this.normals,c)):[0,0,0],o.density=n[15]*i}),!0}};function Uf(s){let e=[0,1,2].map(r=>[s[r],s[4+r],s[8+r]]),t=e.map(r=>e.reduce((i,n)=>i+Math.abs(le(r,n)),0));return Math.sqrt(Math.max(...t))}var ki=class s{constructor(e,t){this.head=e;this.gl=t}head;gl;instances=[];version=0;patterns=[];maps=null;bodies=new Map;radii=new Map;sand=[];static async load(e,t){let r=new s(t.head,e);if(r.place(new Map),!e)return r;let{meshes:i,textures:n,projector:a}=t.head,o=await Promise.all(n.map(({repeats:h},f)=>Vf(e,t,f,f!==a?.pattern&&h)));a&&r.patterns.push(o[a.pattern]),r.maps=new Ii(e,t,o,n);let l=i.map((h,f)=>Df(e,t,f)),c=l.map(({vertexArray:h})=>h);for(let h of t.head.sand??[]){let f=t.numbers(i[h.mesh].positions);r.sand.push({heap:new Li(h,f),...l[h.mesh]})}for(let[h,f]of wv(t.head)){let{texture:d,mesh:p}=f,_=d===null?null:o[d],y=d!==null&&n[d].repeats,w=i[p].triangles[2]==="u4",[E,x]=[r.instances.length,i[p].pieces];r.instances.push(new Sa(E,f,h,c[p],_,y,w,x))}return r.select(0),r.place(new Map),r}select(e){let t=new Set(this.head.bodies.flatMap(({name:r})=>Ma(this.head,e,r).map(i=>Fi(r,i))));for(let r of this.instances)r.isPresent=t.has(Fi(r.body,r.visual));this.version+=1,this.computeRadii()}place(e){for(let r of this.head.bodies)this.bodies.set(r.name,e.get(r.name)??nt(r.pose));let t=!1;for(let r of this.instances)t=r.place(this.body(r.body))||t;t&&(this.version+=1,this.computeRadii())}setSand(e,t){let{gl:r}=this,{heap:i,positions:n,normals:a}=this.sand[e]??{};if(!r||!i||!n||!a||!(t instanceof Float32Array?i.set(t):i.apply(t)))return;let o=i.surface();r.bindBuffer(r.ARRAY_BUFFER,n),r.bufferData(r.ARRAY_BUFFER,o.positions,r.STATIC_DRAW),r.bindBuffer(r.ARRAY_BUFFER,a),r.bufferData(r.ARRAY_BUFFER,o.normals,r.STATIC_DRAW),this.version+=1}heights(e){return this.sand[e]?.heap.heights??new Float32Array}body(e){return this.bodies.get(e)??nt([0,0,0,1,0,0,0])}worldFromMount(e){let t=nt(e.pose);return e.body===null?t:Ie(this.body(e.body),t)}radius(e){return this.radii.get(e.visual.part)??0}computeRadii(){let e=new Map;for(let{visual:t,pieces:r,isPresent:i}of this.instances){if(!i)continue;let n=e.get(t.part)??[1/0,1/0,1/0,-1/0,-1/0,-1/0];for(let{centre:a,radius:o}of r)for(let l=0;l<3;++l)n[l]=Math.min(n[l],a[l]-o),n[3+l]=Math.max(n[3+l],a[l]+o);e.set(t.part,n)}for(let[t,r]of e)this.radii.set(t,Math.max(r[3]-r[0],r[4]-r[1],r[5]-r[2])/2)}};function Ma(s,e,t){return s.trials?.[e]?.visuals?.[t]??s.bodies.find(({name:i})=>i===t)?.visuals??[]}function Fi(s,e){return`${s} ${JSON.stringify(e)}`}function wv(s){let e=s.bodies.flatMap(({name:r,visuals:i})=>i.map(n=>[r,n])),t=new Set(e.map(([r,i])=>Fi(r,i)));for(let{visuals:r={}}of s.trials??[])for(let[i,n]of Object.entries(r))for(let a of n){let o=Fi(i,a);t.has(o)||e.push([i,a]),t.add(o)}return e}var xv=["#ff5a4f","#45d96b","#4aa3ff"],Is=.02,Ps=11,Ev=[0,1,-1,2,-2,3,-3,4,-4,5,-5],Ta=class{constructor(e,t,r){this.context=e;this.intrinsics=r;this.cameraFromWorld=Ze(t)}context;intrinsics;labelBoxes=[];cameraFromWorld;line(e,t,r=1.5,i=[]){let{context:n}=this;n.strokeStyle=t,n.lineWidth=r,n.setLineDash(i),n.beginPath();let a=null;for(let o of e){let l=Re(this.cameraFromWorld,o);if(a&&(a[2]<-Is||l[2]<-Is)){let[c,h]=[Gf(a,l),Gf(l,a)];n.moveTo(...this.pixel(c)),n.lineTo(...this.pixel(h))}a=l}n.stroke()}project(e){let t=Re(this.cameraFromWorld,e);return t[2]<-Is?this.pixel(t):null}label(e,t,r="#ffffff"){let i=this.project(e);if(!i)return;let{context:n}=this;n.font=`${Ps}px system-ui, sans-serif`;let a=this.findSpot(i,n.measureText(t).width);if(!a)return;let[o,l]=a;Math.abs(l-i[1])>2*Ps&&this.drawLeader(i,[o-2,l-Ps/3],r),n.lineWidth=3,n.setLineDash([]),n.strokeStyle="rgba(0, 12, 24, 0.75)",n.strokeText(t,o,l),n.fillStyle=r,n.fillText(t,o,l)}findSpot([e,t],r){for(let i of Ev)for(let n of[e+5,e-5-r]){let a=t-5+i*(Ps+3),o=[n-2,a-Ps,n+r+2,a+3];if(!this.labelBoxes.some(l=>o[0]<l[2]&&o[2]>l[0]&&o[1]<l[3]&&o[3]>l[1]))return this.labelBoxes.push(o),[n,a]}return null}drawLeader(e,t,r){let{context:i}=this;i.strokeStyle=r,i.lineWidth=.75,i.setLineDash([]),i.beginPath(),i.moveTo(...e),i.lineTo(...t),i.stroke()}dot(e,t,r){let i=this.project(e);i&&(this.context.fillStyle=t,this.context.beginPath(),this.context.arc(i[0],i[1],r,0,2*Math.PI),this.context.fill())}pixel([e,t,r]){let{fx:i,fy:n,cx:a,cy:o,skew:l}=this.intrinsics;return[a+(i*e+l*t)/-r+.5,o-n*t/-r+.5]}};function Gf(s,e){if(s[2]<-Is)return s;let t=(-Is-s[2])/(e[2]-s[2]);return s.map((r,i)=>r+t*(e[i]-r))}function zf(s,e,t,r,i,n,a,o){let l=new Ta(s,e,t);for(let{name:c,at:h,colour:f,lines:d}of n.markers(a.time)){for(let p of d)l.line(p,f);d.length||l.dot(h,f,3),(o.labels||!d.length)&&l.label(h,c)}if(o.trails&&Av(l,r,n,a),o.sonars)for(let c of r.sensors)Mv(l,c,i.worldFromMount(c),a);if(o.frames)Sv(l,r,i,o.labels);else if(o.labels)for(let{name:c,body:h}of r.vehicles)l.label(me(i.body(h)),c);for(let c of a.points("contacts",["x","y","z"]))l.dot(c,"#ffb02e",4);for(let{name:c,body:h}of r.vehicles)Tv(l,c,i.body(h),a)}function Av(s,e,t,r){let i=e.vehicles.map(({body:a})=>a),n=e.bodies.filter(a=>a.vehicle===null).map(({name:a})=>a);for(let a of[...i,...n]){let o=r.poses.get(a);if(!o)continue;let l=t.trail(a,r.time);s.line([...l,me(o)],"rgba(255, 214, 92, 0.9)",1.5)}}function Sv(s,e,t,r){let i=e.vehicles.length>1,n=new Map(e.bodies.map(({name:a,vehicle:o})=>[a,o??""]));for(let{name:a,body:o,pose:l}of e.frames){let c=t.worldFromMount({body:o,pose:l}),h=o===null?1:.25;xv.forEach((d,p)=>{let _=[0,1,2].map(y=>y===p?h:0);s.line([me(c),Re(c,_)],d,2)});let f=i&&o!==null?`${n.get(o)} `:"";r&&s.label(me(c),f+a.split("/").at(-1))}}function Mv(s,e,t,r){let i="rgba(120, 220, 255, 0.8)",n=r.signal(`range/${e.name}`);if(e.kind==="range"){let l=n??e.reach,c=Re(t,[l,0,0]);s.line([me(t),c],i,1.5,n===void 0?[4,4]:[]),n!==void 0&&s.dot(c,"#78dcff",3),n!==void 0&&s.label(c,`${n.toFixed(2)} m`,"#bfeeff");return}let a=l=>e.kind==="fan"?[0,Math.sin(l),-Math.cos(l)]:[Math.cos(l),Math.sin(l),0],o=Array.from({length:33},(l,c)=>{let h=e.from+(e.to-e.from)*c/32;return Re(t,a(h).map(f=>f*e.reach))});s.line([me(t),...o,me(t)],i,1)}function Tv(s,e,t,r){let i=["x","y","z"].map(h=>r.signal(`water/${e}/${h}`)??0),n=Math.hypot(...i);if(n<.005)return;let a=Me(me(t),[0,0,.55]),o=Me(a,i,(.5+2*n)/n),l=[-i[1]/n,i[0]/n,0],c=Me(o,i,-.15/n);s.line([a,o],"#5ee6d0",2.5),s.line([Me(c,l,.08),o,Me(c,l,-.08)],"#5ee6d0",2.5),s.label(o,`current ${n.toFixed(2)} m/s`,"#b9fff1")}function Ra(s,e,t,r,i,n){let a=t.fx/e.fx;for(let[o,l,c]of[["truth","#45f08b",[]],["estimate","#ff9f43",[6,4]]]){let h=n.points(`${o}/${e.name}`,["u","v"]);if(!(h.length<2)){s.strokeStyle=l,s.lineWidth=2,s.setLineDash([...c]),s.beginPath();for(let[f,d]of h)s.lineTo(r+t.cx+(f-e.cx)*a+.5,i+t.cy+(d-e.cy)*a+.5);s.closePath(),s.stroke(),s.setLineDash([])}}}function Bf(s,e,t,r){let[i,n]=[28,r+22],a=Rv(130*t/e.fx),o=a*e.fx/t;s.save(),s.setLineDash([]),s.shadowColor="rgba(0, 12, 24, 0.9)",s.shadowBlur=3,s.fillStyle=s.strokeStyle="#ffffff",s.textAlign="center",s.font="600 13px system-ui, sans-serif",s.fillText("N",i,n),s.beginPath(),s.moveTo(i,n+6),s.lineTo(i+8,n+28),s.lineTo(i,n+23),s.lineTo(i-8,n+28),s.closePath(),s.fill();let[l,c]=[18,n+58];s.lineWidth=2,s.beginPath(),s.moveTo(l,c-6),s.lineTo(l,c),s.lineTo(l+o,c),s.lineTo(l+o,c-6),s.stroke(),s.fillText(a<1?`${Math.round(100*a)} cm`:`${a} m`,l+o/2,c-8),s.restore()}function Rv(s){let e=10**Math.floor(Math.log10(s)),t=[5,2,1].find(r=>r*e<=s*(1+1e-9))??1;return Number((t*e).toPrecision(1))}function ls(s){let e=s.getExtension("WEBGL_debug_renderer_info"),t=e?String(s.getParameter(e.UNMASKED_RENDERER_WEBGL)):"";return/swiftshader|llvmpipe|software|softpipe/i.test(t)}var Ci=class{constructor(e){this.gl=e}gl;fence=null;beginTime=0;pauseEnd=0;responsiveEnd=0;begin(){this.fence&&this.gl.deleteSync(this.fence),this.fence=this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE,0),this.gl.flush(),this.beginTime=performance.now()}skipPauses(){this.responsiveEnd=performance.now()+300}isReady(e){let{gl:t,fence:r}=this,i=t.isContextLost()||e-this.beginTime>2e3;return r&&(i||t.getSyncParameter(r,t.SYNC_STATUS)===t.SIGNALED)&&(t.deleteSync(r),this.fence=null,this.pauseEnd=Math.min(2*e-this.beginTime,e+100)),!this.fence&&(e>=this.pauseEnd||e<this.responsiveEnd)}};var Lv=.3,Pa=5,Pv=20,[Iv,kv]=[.05,2.05],Fv=Math.SQRT2,Ia=we([.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1]);function Cv(s){let e=[0,4,8,12].map(r=>[s[r],s[r+1],s[r+2],s[r+3]]);return[1,-1].flatMap(r=>[0,1,2].map(i=>e[3].map((n,a)=>n+r*e[i][a]))).map(r=>{let i=Math.hypot(r[0],r[1],r[2]);return r.map(n=>n/i)})}function ks(s,e){let t=Cv(e.clip),r=Ze(e.worldFromCamera),i=[];for(let n of s){let a=Re(r,n.centre);if(!t.every(l=>le(l,a)+l[3]+n.radius>0))continue;let o=n.corners.map(l=>Re(r,l));t.every(l=>o.some(c=>le(l,c)+l[3]>0))&&i.push([Math.hypot(...a)+n.radius,n])}return i.sort((n,a)=>n[0]-a[0]).map(([,n])=>n)}function Ov(s,e,t,r,i){let n=Nv(t),a=me(r.worldFromCamera),o=[r.worldFromCamera[2],r.worldFromCamera[6],r.worldFromCamera[10]],l=Dv(r),c=e.map(h=>{let f=h.corners.map(w=>le(Me(a,w,-1),o)),p=[Math.max(0,Math.min(...f)),Math.max(0,Math.max(...f))].flatMap(w=>l.map(E=>Me(a,E,w))),[_,y]=[La(h.corners,n),La(p,n)];return _.map(([w,E],x)=>[Math.max(w,y[x][0]),Math.min(E,y[x][1])])});return s.filter(h=>{let f=La(h.corners,n);return c.some(d=>[0,1].every(p=>f[p][0]<=d[p][1]+i&&f[p][1]>=d[p][0]-i)&&f[2][1]>=d[2][0]-i)})}function Nv(s){return s[2]<Lv?[...Wf(s),s]:[[1,0,-s[0]/s[2]],[0,1,-s[1]/s[2]],s]}function La(s,e){return e.map(t=>{let r=s.map(i=>le(t,i));return[Math.min(...r),Math.max(...r)]})}function Dv({clip:s,worldFromCamera:e}){return[[-1,-1],[-1,1],[1,-1],[1,1]].map(([r,i])=>{let n=(i+s[6])/s[5],a=(r+s[2]-s[1]*n)/s[0];return[e[0]*a+e[1]*n-e[2],e[4]*a+e[5]*n-e[6],e[8]*a+e[9]*n-e[10]]})}function Wf(s){let e=[-s[0],-s[1],-s[2]],t=xt(it(e,Math.abs(s[2])<.9?[0,0,1]:[1,0,0]));return[t,it(t,e)]}function Hf(s,e){let t=[...Wf(e),[-e[0],-e[1],-e[2]]],r=[1/0,1/0,1/0],i=[-1/0,-1/0,-1/0];for(let{centre:h,radius:f}of s)t.forEach((d,p)=>{r[p]=Math.min(r[p],le(d,h)-f),i[p]=Math.max(i[p],le(d,h)+f)});let n=Math.max(i[0]-r[0],i[1]-r[1])/2,a=20,o=[1/n,1/n,2/(i[2]+a-r[2])],l=[(r[0]+i[0])/2,(r[1]+i[1])/2,(i[2]+a+r[2])/2],c=t.flatMap((h,f)=>[h[0]*o[f],h[1]*o[f],h[2]*o[f],-o[f]*l[f]]);return[we([...c,0,0,0,1]),2*n]}function Yf(s,e){if(!(s.density>0)||le(s.normal,s.normal)===0)return!1;let t=Ze(e.worldFromCamera),r=s.corners.map(f=>Re(t,f)),i=$s(e.worldFromCamera,s.normal),n=r.map(f=>-f[2]);if(Math.min(...n)<=0)return!1;let a=Math.min(...r.map(f=>Math.abs(le(i,f)))),o=Math.max(...r.map(f=>Math.hypot(...f))),l=Math.hypot(i[0],i[1]),c=Math.min(e.intrinsics.fx,e.intrinsics.fy),h=Math.max(...n)/c*(1+l*o/a);return s.density*h<=Fv}function qf(s,e,t,r,i,n){let a=Vv(s,e,n),o=({instance:f})=>a.has(f.visual.part),l=f=>s.radius(f.instance)<=Pa||o(f),c=e.filter(f=>f.instance.visual.opacity>=1&&l(f)),h=Ov(c,t,r,i,c.some(o)?kv:Iv);return{casters:h,hasHulls:h.some(o)}}function Vv(s,e,t){let r=new Map;for(let{instance:a,corners:o}of e){let l=s.radius(a);if(l<=Pa||l>Pv)continue;let c=o.map(d=>d[2]),[h,f]=r.get(a.visual.part)??[1/0,-1/0];r.set(a.visual.part,[Math.min(h,...c),Math.max(f,...c)])}let i=new Map(e.map(({instance:a})=>[a.visual.part,s.radius(a)])),n=[...r].filter(([a,[o,l]])=>l<t&&l-o>.4*i.get(a));return new Set(n.map(([a])=>a))}function Xf(s){let t=s.instances.filter(r=>r.isPresent&&s.radius(r)>Pa).flatMap(({pieces:r})=>r.flatMap(({corners:i})=>i.map(n=>n[2])));return t.length?t.reduce((r,i)=>Math.min(r,i)):-1/0}var Oi=512,jf=1024,Uv=.008,Ct=512,Gv=80*Math.PI/180,$f=1.02,zv=1024,Fs=class{constructor(e,t,r){this.gl=e;this.width=t;this.height=r;this.texture=e.createTexture(),e.bindTexture(e.TEXTURE_2D,this.texture),e.texStorage2D(e.TEXTURE_2D,1,e.DEPTH_COMPONENT24,t,r);for(let[i,n]of[[e.TEXTURE_COMPARE_MODE,e.COMPARE_REF_TO_TEXTURE],[e.TEXTURE_COMPARE_FUNC,e.LEQUAL],[e.TEXTURE_MIN_FILTER,e.LINEAR],[e.TEXTURE_MAG_FILTER,e.LINEAR],[e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE],[e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE]])e.texParameteri(e.TEXTURE_2D,i,n);this.buffer=e.createFramebuffer(),e.bindFramebuffer(e.FRAMEBUFFER,this.buffer),e.framebufferTexture2D(e.FRAMEBUFFER,e.DEPTH_ATTACHMENT,e.TEXTURE_2D,this.texture,0),e.drawBuffers([e.NONE]),this.begin(0,0,t,r)}gl;width;height;texture;buffer;begin(e,t,r,i){let n=this.gl;n.bindFramebuffer(n.FRAMEBUFFER,this.buffer),n.viewport(e,t,r,i),n.enable(n.SCISSOR_TEST),n.scissor(e,t,r,i),n.depthMask(!0),n.clearDepth(1),n.clear(n.DEPTH_BUFFER_BIT),n.disable(n.SCISSOR_TEST)}},Ni=class{constructor(e,t,r){this.gl=e;this.programs=t;this.instanceBlocks=r;let i=[Oi,jf].map(n=>[n,new Fs(e,n,n)]);this.suns=Object.fromEntries(i),this.sunMap=this.suns[Oi]}gl;programs;instanceBlocks;suns;sunMap;textureFromWorld=we([1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]);lift=0;lampMaps=null;projectorMap=null;sunKey="";lampKeys=[];updateSunShadows(e,t,r){let i=`${r} ${t} ${e.map(l=>`${l.instance.index}.${l.firstIndex}`)}`;if(i===this.sunKey)return;this.sunKey=i;let[n,a]=Hf(e,t),o=a/Oi<=Uv?Oi:jf;this.sunMap=this.suns[o],this.textureFromWorld=Ie(Ia,n),this.lift=1.5*a/o,this.sunMap.begin(0,0,o,o),this.draw(e,n)}updateLampShadows(e,t,r){this.lampMaps??=new Fs(this.gl,2*Ct,2*Ct),e.forEach(({lamp:i,worldFromLamp:n},a)=>{let o=i.shadow?`${r} ${i.half_angle} ${n}`:"none";if(o===this.lampKeys[a])return;this.lampKeys[a]=o;let[l,c]=[a%2,a>>1];this.lampMaps.begin(Ct*l,Ct*c,Ct,Ct),i.shadow&&this.drawShadowMap(n,Kf(i),t)})}updateProjectorShadows(e,t,r){this.projectorMap??=new Fs(this.gl,t.width,t.height),this.projectorMap.begin(0,0,t.width,t.height),this.drawShadowMap(e,t,r)}drawShadowMap(e,t,r){let i=qt(t,!0),n=ks(r,{worldFromCamera:e,clip:i,intrinsics:t});this.draw(n.filter(Di),Ie(i,Ze(e)),!0)}draw(e,t,r=!1){let i=this.gl;i.enable(i.DEPTH_TEST),i.depthFunc(i.LEQUAL),i.enable(i.POLYGON_OFFSET_FILL),i.polygonOffset(1.5,2),this.instanceBlocks.fill(t);for(let n of e){let{texture:a,visual:o}=n.instance,l=a?Aa(o.material):{};i.useProgram(this.programs.get("shadow",l)),l.ALPHA_TEST&&(i.activeTexture(i.TEXTURE0+Q.base_map),i.bindTexture(i.TEXTURE_2D,a)),this.instanceBlocks.drawPiece(n,r)}i.disable(i.POLYGON_OFFSET_FILL)}};function Di(s){return s.instance.visual.opacity>=1}function Kf(s){let e=Ct/2/($f*Math.tan(Math.min(s.half_angle,Gv))),t=(Ct-1)/2,[r,i]=[Ct,Ct];return{width:r,height:i,fx:e,fy:e,cx:t,cy:t,skew:0,near:.1,far:20}}function Qf(s,e,t){let r=zv/Math.max(t,e),i=Math.max(1,Math.round(r*e)),n=Math.max(1,Math.round(r*t)),a=Math.tan(s.fovy/2);return{width:i,height:n,fx:i/2/(a*e/t),fy:n/2/a,cx:(i-1)/2,cy:(n-1)/2,skew:0,near:.1,far:20}}function Jf(s,e){let t=new Float32Array(112),r=Ze(e);return s.forEach(({lamp:i,worldFromLamp:n},a)=>{let[o,l]=[.25+.5*(a%2),.25+.5*(a>>1)],c=we([.25,0,0,o,0,.25,0,l,0,0,.5,.5,0,0,0,1]),h=Ie(c,qt(Kf(i),!0));t.set(ht(Ie(Ie(h,Ze(n)),e)),16*a);let f=Ie(r,n),d=Math.cos(i.half_angle),p=Math.cos((1-i.softness)*i.half_angle),_=2*$f*Math.tan(i.half_angle)/Ct,y=f;t.set([...me(y),d],64+4*a),t.set([y[2],y[6],y[10],1/Math.max(p-d,1e-5)],80+4*a),t.set([...i.colour.map(w=>w*i.intensity),1.5*_],96+4*a)}),t}function Zf(s,e,t,r){let i=Ie(Ze(e),r),n=Ie(Ia,qt(t,!0)),a=Ze(i);return Float32Array.from([...ht(Ie(n,i)),...me(a),s.laser?1:0,a[2],a[6],a[10],1.5/Math.min(t.fx,t.fy)])}function eu(s,e,t,r,i){let{fx:n,fy:a,cx:o,cy:l,skew:c}=e,[h,f]=[1/n,-1/a],d=c*f/n,p=f*(-.5-l),_=h*(-.5-o)-c*p/n,y=E=>E.map(x=>r*x),w=new Float32Array(76);return w.set([...s.absorption,s.field[0],...s.scattering,s.field[1],...Array.from({length:8},(E,x)=>i[x]??0),0,s.exposure,s.scale,0,...y(s.beam),0,...s.beam_loss,0,...y(s.total),0,...s.loss,0,...s.reflectance,s.sun[2],...s.phase,_,p,-1,0,h,0,0,0,-d,f,0,0]),t.forEach(({lamp:E,index:x},M)=>{let S=Math.cos(E.half_angle);w.set([...s.lamps[x],S*S,+(E.half_angle<Math.PI/2)],4*(15+M))}),w}var[Bv,Wv]=[.0625,.1875],Hv=.1875,Yv=24;function tu(s,e,t){let r=Math.sqrt(s.fx*s.fy),i=Math.min(Math.round(Math.log(Math.max(.41*r,1))/Math.log(2.6)),7);if(!t||i<1)return{deviations:[],spreads:[],reach:[],highestFrequency:120};let n=(.41*r)**(1/i),a=Array.from({length:i+1},(l,c)=>n**c),o=a.map(l=>l/r);return{deviations:o,spreads:a.map(Xv),reach:o.map(l=>qv(l,e,s)),highestFrequency:Math.min(120,.3*r)}}function ru(s){return{RADIUS:su(s),SPREAD:Math.round(1e3*s)}}function su(s){return s>0?Math.min(Math.ceil(3*s),Yv):0}function qv(s,e,t){let[r,i]=[t.width/t.fx/2,t.height/t.fy/2],n=[r,i].map(o=>e.map(l=>Math.min(s*l,o)**2)),a=0;for(let o of n[0])for(let l of n[1])a+=Math.sqrt(1+o+l);return e.length**2/a}function Xv(s,e){let[t,r]=[0,0];for(let n=0;n<=e;++n)t=t/4+(n<2?Bv:Wv),r=r/4+Hv;let i=(s/2**(e+1))**2-t-r;return i>.01?jv(i):0}function jv(s){let[e,t]=[.1,2*Math.sqrt(s)+1];for(;t-e>5e-4;){let r=(e+t)/2,[i,n]=[1,0];for(let a=1;a<=su(r);++a){let o=2*Math.exp(-a*a/(2*r*r));i+=o,n+=o*a*a}n<s*i?e=r:t=r}return Math.round(500*(e+t))/1e3}function iu(s,e,t){let r=new Float32Array(4*t*255),i=Math.log(e.highestFrequency/.5)/35,n=Array.from({length:36},(l,c)=>.5*Math.exp(c*i)),a=n.map(l=>$v(s,l)),o=[0,...e.deviations].map(l=>n.map(c=>Math.exp(-2*(Math.PI*c*l)**2)));for(let l=0;l<128;++l){let c=l/127,h=s.scale*c/Math.max(1-c,1e-6);for(let f=0;f<3;++f){let[d,p]=[s.absorption[f],s.scattering[f]],_=s.field[0]+s.field[1]*Math.sqrt(d*h),[y,w]=[Math.exp(-(d+p)*h),Math.exp(-h*d-_*p*h)];if(!(w-y>1e-9))continue;let E=a.map(M=>{let S=(M/s.forward)**12;return Math.exp(h*(p*(M-(_-(1-s.forward))*S)-(d+p)))});Kv(o,E,y,w).forEach((M,S)=>r[4*(255*S+2*l)+f]=M)}}for(let l=0;l<t;++l)for(let c=1020*l+4;c<1020*(l+1);c+=8)for(let h=0;h<3;++h)r[c+h]=(r[c+h-4]+r[c+h+4])/2;for(let l=0;l<255;++l){let c=l/254,h=s.scale*c/Math.max(1-c,1e-6);for(let f=0;f<3;++f)r[4*l+f]+=Math.exp(-(s.absorption[f]+s.scattering[f])*h)}return r}function $v({transform:s},e){let{values:t,min_frequency:r,max_frequency:i}=s,n=Math.log(e/r)/Math.log(i/r)*(t.length-1),a=Math.min(Math.max(Math.floor(n),0),t.length-2);return t[a]+(n-a)*(t[a+1]-t[a])}function Kv(s,e,t,r){let i=s.map(d=>[...d.map((p,_)=>p/e[_]),1e3/r]),n=[...e.map(d=>(d-t)/d),1e3*(r-t)/r],a=(d,p)=>d.reduce((_,y,w)=>_+y*p[w],0),o=i.map(d=>a(d,n)),l=i.map((d,p)=>i.map((_,y)=>a(d,_)*(p===y?1+1e-9:1))),c=s.map(()=>0),h=s.map((d,p)=>p);for(;h.length;){let d=Qv(h.map(_=>[...h.map(y=>l[_][y]),o[_]])),p=Math.min(...d);if(p>=0){h.forEach((_,y)=>c[_]=d[y]);break}h=h.filter((_,y)=>y!==d.indexOf(p))}let f=c.reduce((d,p)=>d+p,0);return f>0?c.map(d=>d*(r-t)/f):c}function Qv(s){let e=s.length;for(let r=0;r<e;++r){let i=r;for(let n=r+1;n<e;++n)Math.abs(s[n][r])>Math.abs(s[i][r])&&(i=n);[s[r],s[i]]=[s[i],s[r]];for(let n=r+1;n<e;++n){let a=s[n][r]/s[r][r];for(let o=r;o<=e;++o)s[n][o]-=a*s[r][o]}}let t=new Array(e).fill(0);for(let r=e-1;r>=0;--r){let i=s[r][e];for(let n=r+1;n<e;++n)i-=s[r][n]*t[n];t[r]=i/s[r][r]}return t}var cs=[41,31],Jv=Math.sqrt(1-1/1.34**2),Zv=.05,eg=.1,nu=.84,au=60,ou=1e9;function cu(s,e,t,r,i,n){let[a,o]=cs,l=new Float32Array(4*a*o),{fx:c,fy:h,cx:f,cy:d,skew:p,width:_,height:y}=t,w=ka(s,Math.max(r,0),i,n);for(let E=0;E<o;++E)for(let x=0;x<a;++x){let M=-(y*E/(o-1)-.5-d)/h,S=(_*x/(a-1)-.5-f-p*M)/c;l.set(w(Xr(e,xt([S,M,-1]))),4*(a*E+x))}return l}function ka(s,e,t,r){let{sun:i,open_water:n}=s,a=s.total.map((l,c)=>l*Math.exp(-s.loss[c]*e)),o=s.beam.map((l,c)=>Math.min(l*Math.exp(-s.beam_loss[c]*e),a[c]));return l=>{let c=l[2],h=c>0?Math.min(e/Math.max(c,1e-6),ou):ou,f=le(l,i),d=rg(n.asymmetry,f),p=3*(1+nu*f*f)/(4*Math.PI*(3+nu)),_=.5+(.5-n.backscatter)*c/Math.sqrt(c*c+eg);return[0,1,2].map(y=>{let w=n.attenuation[y],E=n.scattering[y],x=n.molecules[y],M=o[y]*(Math.PI/i[2])*(E*d+x*p)*lu(w*(1-c/i[2]),h),S=s.reflectance[y]*a[y],k=a[y]-o[y],P=(E*(_*k+(1-_)*S)+.5*x*(k+S))*lu(w-s.loss[y]*c,h),F=c>0&&!r?tg(s,y,c)*Math.exp(-Math.min(w*h,700)):0;return t*(M+P+F)})}}function tg(s,e,t){let r=Math.min(Math.max((t-Jv)/(2*Zv)+.5,0),1),i=r*r*(3-2*r);return i*s.open_water.window+(1-i)*s.reflectance[e]*s.total[e]}function rg(s,e){let t=s,r=Math.sqrt(1+t*t-2*t*Math.min(Math.max(e,-1),1));return(1-t*t)/(4*Math.PI*r**3)}function lu(s,e){let t=Math.min(Math.max(s*e,-au),au);return Math.abs(t)<1e-4?e*(1-t/2):(1-Math.exp(-t))/s}var sg=[2654435769,2135587861],[ig,ng]=[[3210233709,484763065],[2496678331,321982955]],ag=[[3605593784,1717173651],[2692095332,2025677871],[3875765969,2696161499]];function Ui(s){return[parseInt(s.slice(2,10),16),parseInt(s.slice(10),16)]}function fu(s){let e=Vi([s[0]^s[0]>>>30,s[1]^(s[1]>>>30|s[0]<<2)],ig),t=Vi([e[0]^e[0]>>>27,e[1]^(e[1]>>>27|e[0]<<5)],ng);return[(t[0]^t[0]>>>31)>>>0,(t[1]^(t[1]>>>31|t[0]<<1))>>>0]}function fs(s,...e){return e.reduce((t,r,i)=>fu(uu(t,Vi(og(r),ag[i]))),s)}function at(s,e){let[t,r]=fu(uu(s,Vi([0,e+1],sg)));return(t*2**21+(r>>>11))*2**-53}function og(s){return[Math.floor(s/2**32)>>>0,s>>>0]}function uu(s,e){let t=(s[1]>>>0)+(e[1]>>>0);return[s[0]+e[0]+ +(t>=2**32)>>>0,t>>>0]}function Vi(s,e){let[t,r,i,n]=[s[1]&65535,s[1]>>>16,e[1]&65535,e[1]>>>16],a=r*i+(t*i>>>16),o=t*n+(a&65535);return[r*n+Math.floor(a/65536)+Math.floor(o/65536)+Math.imul(s[0],e[1])+Math.imul(s[1],e[0])>>>0,Math.imul(s[1],e[1])>>>0]}var Kt=10,Fa=2e4,lg=4e6,[cg,fg,ug]=[.02,4,3],[pu,hg,dg,mg,pg]=[64,.25,2,.02,.08],hu=.5,vg=0,[gg,_g,yg,bg]=[.02,9,.1,4];function Gi(s,e,t,r,i){let n=s.classes.map(a=>{let o=new Ca(a,s,e,t,r);if(a.concentration>0)if(a.is_plume)xg(o,s.source,i);else for(du(o,i);o.isFull;)o.shorten(),du(o,i);return o.records});return Float32Array.from(n.flat())}var Ca=class{constructor(e,t,r,i,n){this.sizeClass=e;this.drift=r;this.m=i;this.key=Ui(e.key),this.focal=Math.sqrt(n.fx*n.fy);let a=e.is_plume?t.range*bg:t.range;this.reach=Math.min(a,e.max_diameter*this.focal/hu,n.far);let[o,l]=[(n.cy+.5)/n.fy,(n.cy+.5-n.height)/n.fy],c=Math.abs(n.skew)/n.fx*Math.max(Math.abs(o),Math.abs(l)),[h,f]=[-(n.cx+.5)/n.fx-c,(n.width-.5-n.cx)/n.fx+c];this.slopes=[h,f,l,o];let{velocity:d}=r;this.motion=this.toCamera(d[0],d[1],d[2]+e.rise_speed).map(p=>p*t.exposure_time)}sizeClass;drift;m;records=[];key;slopes;focal;reach;motion;get isFull(){return this.records.length>=Kt*Fa}shorten(){let[e,t,r,i]=this.slopes,n=.9*Fa/this.sizeClass.concentration;this.reach=Math.min(Math.cbrt(3*n/((t-e+.05)*(i-r+.05))),.7*this.reach),this.records.length=0}toCamera(e,t,r){let{m:i}=this;return[i[0]*e+i[4]*t+i[8]*r,i[1]*e+i[5]*t+i[9]*r,i[2]*e+i[6]*t+i[10]*r]}mayContain([e,t,r],i){let{slopes:n}=this;if(r>i||e*e+t*t+r*r>(this.reach+i)**2)return!1;let a=n.map(o=>i*Math.hypot(1,o));return n[0]*-r-e<=a[0]&&e-n[1]*-r<=a[1]&&n[2]*-r-t<=a[2]&&t-n[3]*-r<=a[3]}diameterOf(e){let{min_diameter:t,max_diameter:r,slope:i}=this.sizeClass,n=(r/t)**(1-i);return t*(1+e*(n-1))**(1/(1-i))}add([e,t,r],i,n,a){let{slopes:o,sizeClass:l,motion:c}=this;if(-r<pg)return;let h=i-.02*r+.5*(Math.abs(c[0])+Math.abs(c[1])+Math.abs(c[2]));if(e<o[0]*-r-h||e>o[1]*-r+h||t<o[2]*-r-h||t>o[3]*-r+h)return;let f=Math.hypot(e,t,r)/Math.min(this.reach,i*this.focal/hu);if(f>=1||this.isFull)return;let d=Math.min((1-f)/hg,1),[p,_]=[c,1];if(l.kind===vg){_=-Math.log(Math.max(at(a,0),mg));let y=i*dg*at(a,1);p=c.map((w,E)=>w+y*(2*at(a,E+2)-1))}this.records.push(e,t,r,i/2,...p,n*d,l.reflectance*_,l.kind)}};function du(s,e){let{m:t,sizeClass:r,drift:i,key:n}=s,{concentration:a,depth_scale:o}=r,l=Math.min(Math.max(Math.cbrt(ug/a),cg),fg),c=Math.min(a*l**3,pu/2),h=[0,0,r.rise_speed*i.time],f=[t[3],t[7],t[11]].map((w,E)=>w-(i.displacement[E]+h[E])),[d,p]=mu(s,f,l);for(;d.reduce((w,E,x)=>w*(p[x]-E+1),1)>lg;)s.reach*=.7,[d,p]=mu(s,f,l);let _=.8660254037844387*l+r.max_diameter,y=e-t[11];for(let w=d[0];w<=p[0]&&!s.isFull;++w)for(let E=d[1];E<=p[1];++E)for(let x=d[2];x<=p[2];++x){let M=s.toCamera((w+.5)*l-f[0],(E+.5)*l-f[1],(x+.5)*l-f[2]);if(!s.mayContain(M,_))continue;let S=fs(n,w,E,x),k=wg(at(S,0),c);for(let P=0;P<k;++P){let F=1+5*P,[V,B,O]=[w,E,x].map((W,Z)=>(W+at(S,F+Z))*l-f[Z]),R=y-O;if(R<0)continue;let H=o===null?1:Math.exp(-R/o)-at(S,F+4);if(H<=0)continue;let U=o===null?1:Math.min(H/.05,1),X=s.diameterOf(at(S,F+3));s.add(s.toCamera(V,B,O),X,U,fs(S,P,0,0))}}}function mu({slopes:s,reach:e,m:t},r,i){let n=Math.hypot(Math.max(...s.slice(0,2).map(Math.abs)),Math.max(...s.slice(2).map(Math.abs))),a=Math.atan(n),o=[0,1,2].map(l=>{let c=Math.acos(Math.min(Math.max(-t[4*l+2],-1),1)),h=c<=a?1:Math.cos(c-a),f=Math.PI-c<=a?-1:Math.cos(Math.min(c+a,Math.PI));return[e*Math.min(f,0),e*Math.max(h,0)]});return[0,1].map(l=>o.map((c,h)=>Math.floor((r[h]+c[l])/i)))}function wg(s,e){let[t,r]=[0,Math.exp(-e)],i=r;for(;s>i&&t<pu;)t+=1,r*=e/t,i+=r;return t}function xg(s,e,t){let{m:r,sizeClass:i,drift:n,key:a}=s,[o,l,c]=[i.concentration,i.rise_speed,t-e[2]];if(c<=0)return;let h=Math.floor(o*n.time),f=Math.max(Math.ceil(o*(n.time-c/l)),0,h-Fa+1);for(let d=f;d<=h;++d){let p=fs(a,d),_=n.time-d/o,y=l*_,w=2*Math.PI*at(p,0),E=yg*y*Math.sqrt(at(p,1)),x=2*Math.PI*at(p,2)+_g*_,M=gg*Math.min(10*y,1),S=[E*Math.cos(w)+M*Math.cos(x),E*Math.sin(w)+M*Math.sin(x),y],[k,P,F]=S.map((V,B)=>e[B]+n.velocity[B]*_+V-r[4*B+3]);s.add(s.toCamera(k,P,F),s.diameterOf(at(p,3)),1,p)}}var Eg=1.5,Oa=8,Ag=[4,4,2],zi=class{constructor(e,t){this.gl=e;this.programs=t;this.records=e.createBuffer(),this.lens=e.createBuffer(),this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,this.records);let r=0;Ag.forEach((i,n)=>{e.enableVertexAttribArray(Oa+n),e.vertexAttribPointer(Oa+n,i,e.FLOAT,!1,4*Kt,r),e.vertexAttribDivisor(Oa+n,1),r+=4*i}),e.bindVertexArray(null)}gl;programs;records;lens;vertexArray;draw({spec:e,records:t},r,i){let{gl:n}=this;if(n.clearColor(0,0,0,0),n.clear(n.COLOR_BUFFER_BIT),!t.length)return;n.bindBuffer(n.UNIFORM_BUFFER,this.lens);let a=Float32Array.of(e.aperture/2,1/e.focus_distance,Eg,0);n.bufferData(n.UNIFORM_BUFFER,a,n.STREAM_DRAW),n.bindBufferBase(n.UNIFORM_BUFFER,$t.ParticleLens,this.lens),n.useProgram(this.programs.get("particle",r?{LAMPS:r,...i}:i)),n.enable(n.BLEND),n.blendFunc(n.ONE,n.ONE_MINUS_SRC_ALPHA),n.bindVertexArray(this.vertexArray),n.bindBuffer(n.ARRAY_BUFFER,this.records),n.bufferData(n.ARRAY_BUFFER,Sg(t),n.STREAM_DRAW),n.drawArraysInstanced(n.TRIANGLE_STRIP,0,4,t.length/Kt),n.bindVertexArray(null),n.disable(n.BLEND)}};function Sg(s){let e=new Float64Array(s.length/Kt);for(let i=0,n=0;i<e.length;++i,n+=Kt)e[i]=s[n]**2+s[n+1]**2+s[n+2]**2;let t=Array.from(e.keys()).sort((i,n)=>e[n]-e[i]),r=new Float32Array(s.length);return t.forEach((i,n)=>r.set(s.subarray(Kt*i,Kt*(i+1)),Kt*n)),r}var Cs=6,vu=.42,Mg=.5,Tg=40,Rg=5,Bi=5;function gu(s,e,t,r,i){let n=Ze(i),a=Ui(s.key),o=[];for(let l of kn(s,e,t,r)){let c=Math.sqrt(l[jr]),h=vu*c,f=Math.min(Math.max(t-l[$r],0)/Mg,1)/Cs,d=s.scattering*l[sr]*f/(2*Math.PI*h*h);if(!(d<=1e-4))for(let p of Lg(fs(a,l[Kr]))){let _=Re(n,p.map((y,w)=>l[w]+c*y));_[2]<3*h&&Math.hypot(..._)<Tg&&o.push(..._,h,d)}}return o.length?{lumps:Float32Array.from(o),colour:s.colour}:null}function Lg(s){let e=Array.from({length:Cs},(i,n)=>[0,1,2].map(a=>at(s,Rg+3*n+a))),t=[0,1,2].map(i=>e.reduce((n,a)=>n+a[i],0)/Cs),r=Math.sqrt(12*(1-vu**2)*Cs/(Cs-1));return e.map(i=>i.map((n,a)=>r*(n-t[a])))}var yu=8,Pg=4,_u=2.5,Wi=class{constructor(e,t){this.gl=e;this.programs=t;this.lumps=e.createBuffer(),this.block=e.createBuffer(),this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,this.lumps);for(let[r,i,n]of[["place",4,0],["depth",1,16]])e.enableVertexAttribArray(Ft[r]),e.vertexAttribPointer(Ft[r],i,e.FLOAT,!1,4*Bi,n),e.vertexAttribDivisor(Ft[r],1);e.bindVertexArray(null)}gl;programs;lumps;block;vertexArray;draw({lumps:e,colour:t},r,i){let{gl:n}=this,[a,o]=[1/0,0];for(let c=0;c<e.length;c+=Bi){let h=Math.hypot(e[c],e[c+1],e[c+2]);a=Math.min(a,h-_u*e[c+3]),o=Math.max(o,h+_u*e[c+3])}a=Math.max(a,0),n.bindBuffer(n.UNIFORM_BUFFER,this.block);let l=Float32Array.of(a,(o-a)/(Pg-1),0,0,...t,0);n.bufferData(n.UNIFORM_BUFFER,l,n.STREAM_DRAW),n.bindBufferBase(n.UNIFORM_BUFFER,$t.Clouds,this.block),n.clearColor(0,0,0,0),n.clear(n.COLOR_BUFFER_BIT),n.useProgram(this.programs.get("cloud",r?{LAMPS:r,...i}:i)),n.enable(n.BLEND),n.blendFunc(n.ONE,n.ONE),n.bindVertexArray(this.vertexArray),n.bindBuffer(n.ARRAY_BUFFER,this.lumps),n.bufferData(n.ARRAY_BUFFER,e,n.STREAM_DRAW),n.drawArraysInstanced(n.TRIANGLE_STRIP,0,4,e.length/Bi),n.bindVertexArray(null),n.disable(n.BLEND)}};var Hi=class{constructor(e,t){this.gl=e;this.format=t}gl;format;entries=new Map;find({width:e,height:t},r){let{gl:i,format:n}=this,a=`${e} ${t} ${r}`,o=this.entries.get(a);if(o)return o;this.entries.size>7&&this.deleteAll(),o={surfaces:this.depthTarget(e,t),wateredSurfaces:null,colours:this.target(e,t,1,i.RGBA8),particles:null,clouds:null,shafts:null,mirror:null,sources:[],levels:[]};let[l,c]=[e,t];for(let h=0;h<Math.max(r,1);++h){[l,c]=[Math.ceil(l/2),Math.ceil(c/2)];let f=h===0?Math.min(r,1)+1:r-h;o.sources.push(this.target(l,c,f,n)),o.levels.push({rows:this.target(l,c,1,n),total:this.target(l,c,1,n)})}return this.entries.set(a,o),o}depthTarget(e,t){let{gl:r}=this,i=r.createRenderbuffer();r.bindRenderbuffer(r.RENDERBUFFER,i),r.renderbufferStorage(r.RENDERBUFFER,r.DEPTH_COMPONENT24,e,t);let n=this.target(e,t,1,this.format);return r.framebufferRenderbuffer(r.FRAMEBUFFER,r.DEPTH_ATTACHMENT,r.RENDERBUFFER,i),{...n,depth:i}}target(e,t,r,i){let{gl:n}=this,a=Array.from({length:r},()=>this.texture(e,t,i)),o=n.createFramebuffer();return n.bindFramebuffer(n.FRAMEBUFFER,o),a.forEach((l,c)=>n.framebufferTexture2D(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+c,n.TEXTURE_2D,l,0)),n.drawBuffers(a.map((l,c)=>n.COLOR_ATTACHMENT0+c)),{buffer:o,textures:a,width:e,height:t}}texture(e,t,r){let{gl:i}=this,n=i.createTexture();i.bindTexture(i.TEXTURE_2D,n),i.texStorage2D(i.TEXTURE_2D,1,r,e,t);for(let a of[i.TEXTURE_MIN_FILTER,i.TEXTURE_MAG_FILTER])i.texParameteri(i.TEXTURE_2D,a,i.LINEAR);for(let a of[i.TEXTURE_WRAP_S,i.TEXTURE_WRAP_T])i.texParameteri(i.TEXTURE_2D,a,i.CLAMP_TO_EDGE);return n}upload(e,t,r,i){let{gl:n}=this;n.bindTexture(n.TEXTURE_2D,e),n.texSubImage2D(n.TEXTURE_2D,0,0,0,t,r,n.RGBA,n.FLOAT,i)}deleteAll(){let{gl:e}=this;for(let{surfaces:t,wateredSurfaces:r,colours:i,particles:n,clouds:a,shafts:o,mirror:l,sources:c,levels:h}of this.entries.values())for(let f of[t,i,...[r,n,a,o,l].filter(d=>d!==null),...c,...h.flatMap(({rows:d,total:p})=>[d,p])]){for(let d of f.textures)e.deleteTexture(d);e.deleteFramebuffer(f.buffer),f.depth&&e.deleteRenderbuffer(f.depth)}this.entries.clear()}};var Ig=16,kg=["scattered","blurred","developed"],Fg="6e4",Yi=class s{constructor(e,t,r,i){this.gl=e;this.programs=t;this.nodes=r;this.format=i?e.RGBA16F:e.RGBA32F,this.switches=i?{FAR:Fg}:{},this.particlePass=new zi(e,t),this.cloudPass=new Wi(e,t),this.pool=new Hi(e,this.format),this.map=this.pool.texture(cs[0],cs[1],this.format)}gl;programs;nodes;switches;format;pool;particlePass;cloudPass;map;tables=[];table=null;currentTargets=null;radiance=null;static make(e,t,r){return["EXT_color_buffer_float","OES_texture_float_linear","EXT_float_blend"].every(n=>e.getExtension(n))?new s(e,t,r,!1):!e.getExtension("EXT_color_buffer_float")&&!e.getExtension("EXT_color_buffer_half_float")?null:new s(e,t,r,!0)}plan(e,t){return tu(e,this.nodes,t)}prepare(e,t,r,i,n,a,o){return this.table=i.deviations.length?this.tableOf(e,i):null,this.pool.upload(this.map,cs[0],cs[1],cu(e,t,r,n,a,o)),this.bind(Q.open_water_map,this.map),this.table&&this.bind(Q.weight_table,this.table),this.currentTargets=this.pool.find(r,i.deviations.length),this.radiance=this.currentTargets.surfaces.textures[0],this.currentTargets.surfaces.buffer}mirrorTarget({width:e,height:t}){let r=this.currentTargets;if(!r.mirror){let{gl:i}=this;r.mirror=this.pool.depthTarget(e,t),i.bindTexture(i.TEXTURE_2D,r.mirror.textures[0]);for(let n of[i.TEXTURE_MIN_FILTER,i.TEXTURE_MAG_FILTER])i.texParameteri(i.TEXTURE_2D,n,i.NEAREST)}return r.mirror}drawLampPoints(e){let{gl:t}=this;t.useProgram(this.programs.get("lamp_point",{COLOUR:0,LAMPS:e,...this.switches})),t.depthMask(!1),t.enable(t.BLEND),t.blendFuncSeparate(t.ONE,t.ONE,t.ONE,t.ZERO),t.drawArrays(t.POINTS,0,e),t.disable(t.BLEND),t.depthMask(!0)}drawOver(e){let{gl:t}=this,r=this.currentTargets,{width:i,height:n}=r.surfaces,a=r.wateredSurfaces??=this.pool.depthTarget(i,n);this.bind(Q.surface_image,r.surfaces.textures[0]),this.begin(a),t.depthMask(!0),t.clear(t.DEPTH_BUFFER_BIT),e(),this.radiance=a.textures[0]}develop(e,t,r,i,n,a,o,l){let c=this.pool.find(t,r.deviations.length),h=e.lamp_veil?i:0,f=this.table?{BLUR:1}:{};if((r.spreads.length||h)&&(this.drawScattered(c,r,h),this.bind(Q.level_0,c.levels[0].total.textures[0]),f.SCATTERED=1),this.bind(Q.surface_image,this.radiance),a){let d=c.particles??=this.pool.target(t.width,t.height,1,this.format);this.begin(d),this.particlePass.draw(a,i,this.switches),this.bind(Q.particle_image,d.textures[0]),f.PARTICLES=1}if(o){let d=[t.width,t.height].map(_=>Math.ceil(_/yu)),p=c.clouds??=this.pool.target(d[0],d[1],3,this.format);this.begin(p),this.cloudPass.draw(o,i,this.switches),p.textures.forEach((_,y)=>this.bind(Q.cloud_layers_map+y,_)),f.CLOUDS=1}if(l){let d=[t.width,t.height].map(_=>Math.ceil(_/Number(l.RATIO))),p=c.shafts??=this.pool.target(d[0],d[1],1,this.format);this.draw("light_shafts",l,p),this.bind(Q.shaft_image,p.textures[0]),f.SHAFTS=l.RATIO}return e.linear&&(f.LINEAR=1),n&&(f.GREY=1),this.draw("developed",f,c.colours),c.colours.textures[0]}present(e,t,r,{width:i,height:n},a,o){let{gl:l}=this;this.bind(Q.level_0,e),l.bindFramebuffer(l.FRAMEBUFFER,t),l.enable(l.SCISSOR_TEST),l.scissor(r[0],r[1],i,n),l.viewport(r[0]-a[0],r[1]-a[1],i+2*a[0],n+2*a[1]),l.useProgram(this.programs.get("presented",o?{}:{FLIPPED:1},"presented")),l.drawArrays(l.TRIANGLES,0,3),l.disable(l.SCISSOR_TEST)}drawScattered({sources:e,levels:t},r,i){let n=r.spreads.length;this.bind(Q.surface_image,this.radiance),this.draw("scattered",{N_LEVELS:Math.min(n,1)},e[0]),n>1&&(this.bind(Q.surface_image,e[0].textures[1]),this.draw("scattered",{WIDE:1,N_LEVELS:n-1},e[1]));for(let a=2;a<e.length;++a)e[a-1].textures.slice(1).forEach((o,l)=>this.bind(Q.level_0+l,o)),this.draw("reduced",{N_LEVELS:e[a].textures.length},e[a]);for(let a=t.length-1;a>=0;--a){let o=r.spreads[a]??0,l=ru(o);this.bind(Q.level_0,e[a].textures[0]),o>0&&(this.draw("blurred_rows",{...l},t[a].rows),this.bind(Q.level_0,t[a].rows.textures[0])),a+1<t.length&&(this.bind(Q.level_1,t[a+1].total.textures[0]),l.WIDER=1),a===0&&i&&(this.bind(Q.level_2,e[0].textures.at(-1)),l.LAMPS=i),n||(l.VEIL_ONLY=1),this.draw("blurred",l,t[a].total)}}begin(e){this.gl.bindFramebuffer(this.gl.FRAMEBUFFER,e.buffer),this.gl.viewport(0,0,e.width,e.height)}draw(e,t,r){let{gl:i}=this;this.begin(r);let n=kg.includes(e)?e:"screen";i.useProgram(this.programs.get(e,{...this.switches,...t},n)),i.drawArrays(i.TRIANGLES,0,3)}bind(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}tableOf(e,t){let r=t.deviations.join(),i=this.tables.find(a=>a.key===r&&a.optics===e.transform);if(i)return i.texture;this.tables.length>=Ig&&this.gl.deleteTexture(this.tables.shift().texture);let n=this.pool.texture(255,9,this.format);return this.pool.upload(n,255,9,iu(e,t,9)),this.tables.push({optics:e.transform,key:r,texture:n}),n}};function wu(s,{drift:e,worldFromCamera:t,water:r},i){return!s?.classes.length||!e?null:{spec:s,records:Gi(s,e,t,i,r.surface_height)}}function xu(s,{drift:e,puffs:t,worldFromCamera:r}){return!s?.sediment||!t||!e?null:gu(s.sediment,t,e.time,e.velocity,r)}function Da(s){return{reals:new Float64Array(s*s),imaginaries:new Float64Array(s*s)}}var qi=class{constructor(e){this.n=e;this.cosines=Float64Array.from({length:e/2},(r,i)=>Math.cos(2*Math.PI*i/e)),this.sines=Float64Array.from({length:e/2},(r,i)=>Math.sin(2*Math.PI*i/e));let t=Math.round(Math.log2(e));this.reversedIndices=Array.from({length:e},(r,i)=>{let n=0;for(let a=0;a<t;++a)i&1<<a&&(n|=1<<t-1-a);return n})}n;cosines;sines;reversedIndices;transform({reals:e,imaginaries:t},r){let{n:i}=this;for(let n=0;n<i;++n)this.pass(e,t,i*n,1,1,r);this.pass(e,t,0,i,i,r)}pass(e,t,r,i,n,a){let{n:o,reversedIndices:l,cosines:c,sines:h}=this;for(let f=0;f<o;++f){if(l[f]<=f)continue;let[d,p]=[r+i*f,r+i*l[f]];for(let _=0;_<n;++_,++d,++p){let[y,w]=[e[d],t[d]];e[d]=e[p],t[d]=t[p],e[p]=y,t[p]=w}}for(let f=1;f<o;f*=2){let d=o/(2*f);for(let p=0;p<o;p+=2*f)for(let _=0;_<f;++_){let y=c[_*d],w=a*h[_*d],E=r+i*(p+_),x=E+i*f;for(let M=0;M<n;++M,++E,++x){let S=e[x]*y-t[x]*w,k=e[x]*w+t[x]*y;e[x]=e[E]-S,t[x]=t[E]-k,e[E]+=S,t[E]+=k}}}}};var Cg=30;function Eu({min_depth:s,few_slices:e,many_slices:t,max_ratio:r,max_depth:i,least_floor_depth:n,depth_step:a},o,l){let c=Math.ceil(Math.min(l,i)/a-1e-6)*a,h=Math.min(o,Math.max(c,n)),f=h<=s*r**(e-1)?e:t;return Array.from({length:f},(d,p)=>s*(h/s)**(p/(f-1)))}var Xi=class{constructor(e,t){this.spec=e;this.depths=t;let r=e.n_nodes,[i,,n]=e.covariance,a=Math.sqrt(.5*(i+n))*r/e.edge;this.fourier=new qi(r),[this.slopes,this.pair]=[Da(r),Da(r)],[this.lights,this.traces,this.squares]=[0,1,2].map(()=>new Float32Array(r*r)),this.maps=t.map(()=>new Float32Array(r*r)),this.blurs=t.map(o=>o*a),this.blurs.forEach((o,l)=>{o>=e.maps.least_blur&&this.transfers.set(l,Og(e,t[l]))})}spec;depths;fourier;slopes;pair;lights;traces;squares;maps;blurs;transfers=new Map;compute(e,t){let{spec:r,maps:i,transfers:n}=this;Ac(e,r.edge,r.n_nodes,t,this.slopes),this.fourier.transform(this.slopes,1),this.refractAll(),this.computeSpreads();let{max_spread:a,smooth_blur:o}=r.maps;this.depths.forEach((c,h)=>{let f=this.blurs[h]<o?a:1/0;this.deposit(i[h],c*r.n_nodes/r.edge,f)});let l=[...n.keys()];for(let c=0;c<l.length;c+=2){let[h,f]=[l[c],l[Math.min(c+1,l.length-1)]];this.blur(i[h],i[f],n.get(h),n.get(f))}for(let c of i)for(let h=0;h<c.length;++h)c[h]-=1;return i}refractAll(){let{reals:e,imaginaries:t}=this.slopes,{lights:r}=this,{sun:[i,n,a],drift:[o,l],index:c}=this.spec,h=0;for(let d=0;d<r.length;++d){let[p,_]=[e[d],t[d]],y=1/Math.sqrt(1+p*p+_*_),w=Math.max(a-i*p-n*_,0),E=w*y,x=Math.sqrt(1-(1-E*E)/(c*c)),M=(E/c-x)*y,S=1/(a/c-M),k=(E-c*x)/(E+c*x),P=(x-c*E)/(x+c*E);e[d]=(-i/c-M*p)*S-o,t[d]=(-n/c-M*_)*S-l,r[d]=w*(2-k*k-P*P),h+=r[d]}let f=r.length/h;for(let d=0;d<r.length;++d)r[d]*=f}computeSpreads(){let{traces:e,squares:t,slopes:r}=this,{reals:i,imaginaries:n}=r,a=this.spec.n_nodes,o=a-1;for(let l=0,c=0;l<a;++l){let h=(l-1&o)*a,f=(l+1&o)*a;for(let d=0;d<a;++d,++c){let p=l*a+(d-1&o),_=l*a+(d+1&o),y=.5*(i[_]-i[p]),w=.5*(n[_]-n[p]),E=.5*(i[f+d]-i[h+d]),x=.5*(n[f+d]-n[h+d]);e[c]=y+x,t[c]=y*y+w*w+E*E+x*x}}}deposit(e,t,r){let{lights:i,traces:n,squares:a,slopes:o}=this,{reals:l,imaginaries:c}=o,h=this.spec.n_nodes;e.fill(0);for(let f=0,d=0;f<h;++f)for(let p=0;p<h;++p,++d){let _=p+t*l[d],y=f+t*c[d];2+t*(2*n[d]+t*a[d])<r?Ng(e,h,_,y,i[d]):this.addTents(e,t,f,p,_,y)}}addTents(e,t,r,i,n,a){let{reals:o,imaginaries:l}=this.slopes,c=this.spec.n_nodes,h=c-1,f=r*c+(i-1&h),d=r*c+(i+1&h),p=(r-1&h)*c+i,_=(r+1&h)*c+i,y=1+.5*t*(o[d]-o[f]),w=.5*t*(l[d]-l[f]),E=.5*t*(o[_]-o[p]),x=1+.5*t*(l[_]-l[p]),M=.25*this.lights[r*c+i];for(let S=0;S<4;++S){let k=S&1?.25:-.25,P=S&2?.25:-.25,F=n+k*y+P*E,V=a+k*w+P*x,B=Math.floor(F),O=Math.floor(V),R=F-B,H=V-O,U=(O&h)*c,X=(O+1&h)*c,W=B+1&h;e[U+(B&h)]+=M*(1-H)*(1-R),e[U+W]+=M*(1-H)*R,e[X+(B&h)]+=M*H*(1-R),e[X+W]+=M*H*R}}blur(e,t,r,i){let{pair:n,fourier:a}=this,{reals:o,imaginaries:l}=n,{n:c}=a,h=c-1;o.set(e),l.set(t),a.transform(n,-1);for(let f=0;f<c;++f)for(let d=0;d<c;++d){let p=f*c+d,_=(-f&h)*c+(-d&h);if(_<p)continue;let y=.5*(r[p]+i[p]),w=.5*(r[p]-i[p]),[E,x,M,S]=[o[p],l[p],o[_],l[_]];o[p]=y*E+w*M,l[p]=y*x-w*S,o[_]=y*M+w*E,l[_]=y*S-w*x}a.transform(n,1),e.set(o),t.set(l)}};function Og({edge:s,n_nodes:e,covariance:[t,r,i],maps:n},a){let o=2*Math.PI/s,l=(n.map_blur*s/e)**2,c=new Float32Array(e*e);for(let h=0;h<e;++h)for(let f=0;f<e;++f){let[d,p]=[f,h].map(w=>o*(w<e/2?w:w-e)),_=t*d*d+2*r*d*p+i*p*p,y=.5*(a*a*_+l*(d*d+p*p));c[h*e+f]=Math.exp(-Math.min(y,Cg))/(e*e)}return c}function Ng(s,e,t,r,i){let n=e-1,a=Math.floor(t+.5),o=Math.floor(r+.5),l=t-a,c=r-o,h=.5*(.5-l)*(.5-l),f=.75-l*l,d=.5*(.5+l)*(.5+l),p=a-1&n,_=a&n,y=a+1&n,w=i*.5*(.5-c)*(.5-c),E=(o-1&n)*e;s[E+p]+=w*h,s[E+_]+=w*f,s[E+y]+=w*d,w=i*(.75-c*c),E=(o&n)*e,s[E+p]+=w*h,s[E+_]+=w*f,s[E+y]+=w*d,w=i*.5*(.5+c)*(.5+c),E=(o+1&n)*e,s[E+p]+=w*h,s[E+_]+=w*f,s[E+y]+=w*d}function Au({swell:{n_points:s,spacing:e},matrix:[t,r,i,n],wave_lengths:a},{waves:o,time:l,scale:c},h){let f=new Float32Array(4*s*s),{amplitude:d,omega:p,kx:_,ky:y,phase:w}=o,E=new Float64Array(5*s*s);for(let x=0;x<d.length;++x){let[M,S]=[_[x],y[x]];if(2*Math.PI/Math.hypot(M,S)<a[1])continue;let k=c*d[x],P=w[x]+M*h[0]+S*h[1]-p[x]*l;for(let F=0,V=0;F<s;++F)for(let B=0;B<s;++B,V+=5){let O=P+e*(M*B+S*F),[R,H]=[-k*Math.cos(O),-k*Math.sin(O)];E[V]+=M*H,E[V+1]+=S*H,E[V+2]+=M*M*R,E[V+3]+=M*S*R,E[V+4]+=S*S*R}}for(let x=0,M=0;x<E.length;x+=5,M+=4){let[S,k,P,F,V]=E.subarray(x,x+5);f[M]=t*S+r*k,f[M+1]=i*S+n*k,f[M+2]=t*P+(r+i)*F+n*V,f[M+3]=(t*n-r*i)*(P*V-F*F)}return f}var Dg=.2,Vg=.3,ji=class{constructor(e,t,r){this.gl=e;this.spec=t;this.format=r;this.swell=e.createTexture(),e.bindTexture(e.TEXTURE_2D,this.swell),e.texStorage2D(e.TEXTURE_2D,1,r,t.swell.n_points,t.swell.n_points),this.setFilter(e.TEXTURE_2D,e.LINEAR,e.CLAMP_TO_EDGE)}gl;spec;format;maps=new Map;swell;mapper=null;mapKey=null;nextUpdate=0;swellKey=[];corner=[0,0];prepare(e,t,r,i,n,a){this.updateMaps(e,r,a),e.waves&&this.updateSwell(e,i,n);let{gl:o}=this;return o.activeTexture(o.TEXTURE0+Q.caustic_maps),o.bindTexture(o.TEXTURE_2D_ARRAY,this.maps.get(Su(r.length))),o.activeTexture(o.TEXTURE0+Q.swell_map),o.bindTexture(o.TEXTURE_2D,this.swell),o.activeTexture(o.TEXTURE0),this.blockValues(t,r,i,n)}updateMaps({tile:e,time:t},r,i){let n=r.join();this.mapper?.depths!==n&&(this.mapper={depths:n,mapper:new Xi(this.spec,r)});let{mapper:a}=this.mapper,o=this.mapKey?.mapper===a&&this.mapKey.tile===e?Math.abs(t-this.mapKey.time):1/0,l=performance.now();if(o===0||!i&&o<=Dg&&l<this.nextUpdate)return;this.mapKey={mapper:a,tile:e,time:t},this.upload(a.compute(e,t));let c=performance.now();this.nextUpdate=c+(c-l)*(1/Vg-1)}upload(e){let{gl:t,format:r}=this,i=this.spec.n_nodes,n=Su(e.length);t.activeTexture(t.TEXTURE0+Q.caustic_maps);let a=this.maps.get(n)??t.createTexture();t.bindTexture(t.TEXTURE_2D_ARRAY,a),this.maps.has(n)||(this.maps.set(n,a),t.texStorage3D(t.TEXTURE_2D_ARRAY,Math.log2(i)+1,r,i,i,n),this.setFilter(t.TEXTURE_2D_ARRAY,t.LINEAR_MIPMAP_LINEAR,t.REPEAT));let o=new Float32Array(4*i*i*n);for(let l=0;l<n;++l)for(let c=0;c<4;++c){let h=e[2*l+c];for(let f=0,d=4*i*i*l+c;f<h.length;++f,d+=4)o[d]=h[f]}t.texSubImage3D(t.TEXTURE_2D_ARRAY,0,0,0,0,i,i,n,t.RGBA,t.FLOAT,o),t.generateMipmap(t.TEXTURE_2D_ARRAY),t.activeTexture(t.TEXTURE0)}updateSwell(e,t,r){let{gl:i,spec:n}=this,{n_points:a,spacing:o}=n.swell,l=me(t),c=Math.max(r-l[2],0),h=[0,1].map(p=>o*Math.floor((l[p]-c*n.drift[p])/o-.5*a)),f=[e.waves,e.time,e.scale,...h];if(f.every((p,_)=>p===this.swellKey[_]))return;[this.swellKey,this.corner]=[f,h];let d=Au(n,e,h);i.activeTexture(i.TEXTURE0+Q.swell_map),i.bindTexture(i.TEXTURE_2D,this.swell),i.texSubImage2D(i.TEXTURE_2D,0,0,0,a,a,i.RGBA,i.FLOAT,d),i.activeTexture(i.TEXTURE0)}blockValues({loss:e,shafts:t},r,i,n){let{edge:a,drift:o,swell:l,n_nodes:c}=this.spec,h=n-i[11],f=l.n_points*l.spacing/a,d=[0,0,1/f,1/a],p=[0,1].flatMap(y=>{let w=(i[4*y+3]-o[y]*h)/a,E=Math.floor(w);return d[y]=.5/l.n_points-(this.corner[y]/a-E)/f,[...[0,1,2].map(x=>(i[4*y+x]+o[y]*i[8+x])/a),w-E]}),_=Math.log2(r[1]/r[0]);return Float32Array.from([...p,...d,r[0],1/_,-Math.log2(r[0])/_,r.at(-1),...e,...t,c])}setFilter(e,t,r){let{gl:i}=this;for(let[n,a]of[[i.TEXTURE_MIN_FILTER,t],[i.TEXTURE_MAG_FILTER,i.LINEAR],[i.TEXTURE_WRAP_S,r],[i.TEXTURE_WRAP_T,r]])i.texParameteri(e,n,a)}};function Su(s){return s/2-1}var $i=class{constructor(e,t,r){this.spec=t;this.caustics=new ji(e,t,r)}spec;caustics;prepare({focusing:e,worldFromCamera:t,water:r,isExact:i},n,a){let{spec:o,caustics:l}=this,c=n.caustics;if(!c||!e)return null;let h=Eu(o.maps,c.lost_depth,r.surface_height-a),f=l.prepare(e,c,h,t,r.surface_height,i===!0),d={N_SLICES:h.length,...e.waves?{SWELL:1}:{}};return{values:f,surfaces:o.has_caustics?{CAUSTICS:1,...d}:{},shafts:o.shafts&&{...o.shafts,...d}}}};var Os=128,Ug=[-1,-.32,10,-3,.45],Mu=[4,-.7],[Gg,Tu]=[50,154],zg=[.2126,.7152,.0722],Bg=[[3.2406,-1.5372,-.4986],[-.9689,1.8758,.0415],[.0557,-.204,1.057]],Wg=.01;function Ru(s,e,t){let r=Os,i=new Float32Array(8*r*r),n=ka(s,0,t,!0);for(let a=0;a<r;++a)for(let o=0;o<r;++o){let[l,c]=[o,a].map(y=>2*y/(r-1)-1),h=Math.hypot(l,c),f=Math.min(h*h,1),d=2/(1+f)/Math.max(h,1),p=[d*l,d*c,(1-f)/(1+f)],_=4*(r*a+o);i.set(Hg(e,p).map(y=>t*y),_),i.set(n([p[0],p[1],-p[2]]),4*r*r+_)}return i}function Hg(s,e){let t=Math.max(e[2],Wg),r=Math.min(Math.max(le(e,s.sun),-1),1),[i,n,a,o,l]=Ug,c=1+i*Math.exp(n/t),h=1+a*(Math.exp(o*Math.acos(r))-Math.exp(o*Math.PI/2))+l*r*r,f=s.clear*c*h,d=s.overcast*(1+Mu[0]*Math.exp(Mu[1]/t));return Yg(Tu+(Gg-Tu)*Math.sqrt(t)).map(p=>f*p+d)}function Yg(s){let e=s*.001,t=.244063+e*(.09911+e*(2.9678-e*4.607)),r=.23704+e*(.24748+e*(1.9018-e*2.0064)),i=s>1e6/7e3?t:r,n=-3*i*i+2.87*i-.275,a=Bg.map(l=>Math.max(le(l,[i/n,1,(1-i-n)/n]),0)),o=le(a,zg);return a.map(l=>l/o)}var[qg,Xg]=[2,4];function Lu(s,e,t,r,i){let n=we([s[0],-s[1],s[2],s[3],s[4],-s[5],s[6],s[7],-s[8],s[9],-s[10],2*t-s[11],0,0,0,1]),a=i?Xg:qg,[o,l]=[Math.ceil(e.width/a),Math.ceil(e.height/a)],[c,h]=[o/e.width,l/e.height],f=(e.cy+.5)*h-.5,d={...e,width:o,height:l,fx:e.fx*c,fy:e.fy*h,cx:(e.cx+.5)*c-.5,cy:l-1-f,skew:-e.skew*c,far:Math.max(Math.min(e.far,r),2*e.near)};return{pose:n,intrinsics:d}}var or=128,Pu=[.2,.8,3.2,12.8],Va=192,Iu=[.2,.4,.8,1.6],jg=4,$g=6,Kg=.22,Qg=4.5,Ou=9.81,Ki=class{constructor(e,t,r){this.gl=e;this.programs=t;this.format=r;this.textures=[e.createTexture(),e.createTexture()];for(let i of this.textures){e.bindTexture(e.TEXTURE_2D,i);for(let n of[e.TEXTURE_MIN_FILTER,e.TEXTURE_MAG_FILTER])e.texParameteri(e.TEXTURE_2D,n,e.NEAREST)}}gl;programs;format;textures;texture(e,t,r){let{gl:i}=this,n=r?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D,a=i.createTexture();i.bindTexture(n,a),r?i.texStorage3D(n,1,this.format,e,e,r):i.texStorage2D(n,1,this.format,e,e);for(let l of[i.TEXTURE_MIN_FILTER,i.TEXTURE_MAG_FILTER])i.texParameteri(n,l,i.LINEAR);for(let l of[i.TEXTURE_WRAP_S,i.TEXTURE_WRAP_T])i.texParameteri(n,l,t);let o=Array.from({length:r??1},(l,c)=>{let h=i.createFramebuffer();return i.bindFramebuffer(i.FRAMEBUFFER,h),r?i.framebufferTextureLayer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,a,0,c):i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,n,a,0),h});return{texture:a,buffers:o}}draw({amplitude:e,omega:t,kx:r,ky:i,phase:n},[a,o],l,c,h,f){let{gl:d}=this,p=Math.max(e.length,1),[_,y]=[0,1].map(()=>new Float32Array(4*p*h));for(let w=0;w<e.length;++w){let E=r[w]*a+i[w]*o-t[w]*c+n[w],x=t[w]*t[w]/Ou,M=4*h*w;ku(_,M,h,1,E,r[w]*l,[r[w],x]),ku(y,M,h,e[w],0,i[w]*l,[i[w],0])}[_,y].forEach((w,E)=>{d.activeTexture(d.TEXTURE0+[Q.factors_x,Q.factors_y][E]),d.bindTexture(d.TEXTURE_2D,this.textures[E]),d.texImage2D(d.TEXTURE_2D,0,d.RGBA32F,h,p,0,d.RGBA,d.FLOAT,w)}),d.activeTexture(d.TEXTURE0),d.bindFramebuffer(d.FRAMEBUFFER,f),d.viewport(0,0,h,h),d.disable(d.DEPTH_TEST),d.disable(d.CULL_FACE),d.disable(d.BLEND),d.bindVertexArray(null),d.useProgram(this.programs.get("wave_grid",{},"screen")),d.drawArrays(d.TRIANGLES,0,3)}},Qi=class{constructor(e,t){this.sums=t;this.grids=t.texture(or,e.CLAMP_TO_EDGE,Pu.length),this.nearGrid=t.texture(Va,e.CLAMP_TO_EDGE)}sums;grids;nearGrid;frames=[];maxElevation=0;slopeVariance=0;hasFoam=!1;components=null;scale=1;keys=new Map;set(e,t){if(e===this.components&&t===this.scale||([this.components,this.scale]=[e,t],this.frames=[],this.keys.clear(),[this.maxElevation,this.slopeVariance,this.hasFoam]=[0,0,!1],!e))return;let r=[...e.amplitude].map(n=>t*n),i=r.map((n,a)=>n*e.omega[a]**2/Ou);this.maxElevation=Cu(r,$g),this.slopeVariance=Fu(e,t,()=>!0),this.hasFoam=Cu(i,Qg)>Kg}update(e,t){this.frames=Pu.map((r,i)=>this.draw(e,t,r,or,this.grids.buffers[i]))}updateNear(e,t,r){let i=r/(.5*Va-2),n=Iu.find(a=>a>=i)??Iu.at(-1);this.frames=[this.draw(e,t,n,Va,this.nearGrid.buffers[0])]}draw(e,t,r,i,n){let a=this.components,o=f=>f*jg*r<=2*Math.PI,l=[0,1].map(f=>r*(Math.floor(t[f]/r+.5)-i/2)),c=`${e} ${r} ${l}`;this.keys.get(n)!==c&&(this.keys.set(n,c),this.sums.draw(Jg(a,this.scale,o),l,r,e,i,n));let h=Fu(a,this.scale,f=>!o(f));return{origin:l,spacing:r,nPoints:i,roughness:h}}};function ku(s,e,t,r,i,n,a){let[o,l]=[r*Math.cos(i),r*Math.sin(i)],[c,h]=[Math.cos(n),Math.sin(n)];for(let f=e;f<e+4*t;f+=4){s[f]=o,s[f+1]=l,s[f+2]=a[0],s[f+3]=a[1];let d=o*c-l*h;l=l*c+o*h,o=d}}function Jg({amplitude:s,omega:e,kx:t,ky:r,phase:i},n,a){let o=(p,_)=>a(Math.hypot(t[_],r[_])),[l,c,h,f,d]=[s,e,t,r,i].map(p=>p.filter(o));return{amplitude:l.map(p=>n*p),omega:c,kx:h,ky:f,phase:d}}function Fu({amplitude:s,kx:e,ky:t},r,i){let n=0;for(let a=0;a<s.length;++a){let o=Math.hypot(e[a],t[a]);i(o)&&(n+=.25*(r*s[a]*o)**2)}return n}function Cu(s,e){let t=s.reduce((i,n)=>i+n*n,0),r=s.reduce((i,n)=>i+n,0);return Math.min(r,e*Math.sqrt(.5*t))}var lr=5.3,Nu=2,[Du,Vu]=[.55,.43],Zg=.00465,e0=1.34,t0=96,r0=16;function Uu(s,e,t,r,i,n,a,o){let l=me(n),c=zu(n),h=we([n[0],n[4],n[8],0,n[1],n[5],n[9],0,n[2],n[6],n[10],0,0,0,0,1]),f=E=>E.map(x=>o*x),d=[0,1,2,3].map(E=>{let x=t.frames[E];if(!x)return[0,0,0,0];let{origin:M,spacing:S,nPoints:k}=x;return[...[0,1].map(F=>((l[F]-M[F])/S+.5)/k),1/(S*k),S]}),[p,_]=[Math.cos(Du)/Vu,Math.sin(Du)/Vu],y=[p*l[0]-_*l[1],_*l[0]+p*l[1]],w=new Float32Array(t0);return w.set([...ht(Ie(qt(a,!0),h)),...ht(c),r,a.near,0,t.frames.length,...d.flat(),...[0,1,2,3].map(E=>t.frames[E]?.roughness??0),Math.sqrt(i/Nu),i/Nu,1/lr,lr/or,Ji(l[0],5*lr),Ji(l[1],5*lr),0,0,Ji(y[0],lr),Ji(y[1],lr),p,_,t.maxElevation,t.slopeVariance,0,0,...s.sky.sun,Zg,...f(s.sky.sunlight),e.sun[2],...f(s.sky.light),0,...e.reflectance.map((E,x)=>o*E*e.total[x]),0,a.width,a.height,0,0,s.air,e0,1/Math.sqrt(a.fx*a.fy),0]),w}function Gu(s,e){let t=Float32Array.from(s);return t.set(ht(zu(e)),r0),t}function zu(s){return we([s[0],s[1],s[2],0,s[4],s[5],s[6],0,s[8],s[9],s[10],0,0,0,0,1])}function Ji(s,e){return s-e*Math.floor(s/e)}var Tr=32,s0=8,Ns=[.2,12,1500,2e5],i0=[80,48,15],Hu=2,Bu=12,Ds=class{constructor(e,t=1){this.gl=e;let r=this.radii=l0().filter((c,h)=>h%t===0),i=this.nEdges=s0/t,n=Tr*i,a=n+1,o=r.flatMap(c=>Array.from({length:a},(h,f)=>2*Math.PI*f/n).flatMap(h=>[c*Math.cos(h),c*Math.sin(h)])),l=[];for(let c=0;c<Tr;++c)for(let h=0;h<r.length-1;++h)for(let f=0;f<i;++f){let d=a*h+i*c+f,p=d+a;l.push(d,p,p+1,d,p+1,d+1)}this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,e.createBuffer()),e.bufferData(e.ARRAY_BUFFER,Float32Array.from(o),e.STATIC_DRAW),e.enableVertexAttribArray(Ft.vertex),e.vertexAttribPointer(Ft.vertex,2,e.FLOAT,!1,0,0),e.bindBuffer(e.ELEMENT_ARRAY_BUFFER,e.createBuffer()),e.bufferData(e.ELEMENT_ARRAY_BUFFER,Uint32Array.from(l),e.STATIC_DRAW),e.bindVertexArray(null)}gl;vertexArray;radii;nEdges;draw({sectors:e,minRadius:t,maxRadius:r}){let{gl:i,radii:n}=this,a=6*this.nEdges,o=Math.max(Wu(n,t)-2,0),l=Math.min(Wu(n,r)+1,n.length-1)-o;if(!(l<=0)){i.bindVertexArray(this.vertexArray);for(let c of e){let h=c*(n.length-1)*a+o*a;i.drawElements(i.TRIANGLES,l*a,i.UNSIGNED_INT,4*h)}i.bindVertexArray(null)}}};function Yu(s,e,t,r){let i=n0(e).map(([y,w])=>{let E=-(w-e.cy)/e.fy;return Xr(s,[(y-e.cx-e.skew*E)/e.fx,E,-1])}),n=o0(s,e),a=n?Array.from({length:Tr},(y,w)=>w):a0(s,i),o=t>0?-1:1,[l,c]=[Math.abs(t)-r,Math.abs(t)+r],h=i.map(([y,w,E])=>o*E/Math.hypot(y,w)),[f,d]=[1.05*Math.max(...h),.95*Math.min(...h)],[p,_]=[0,Ns[3]];if(l>0){!n&&f<=0&&(a=[]),n||(p=l/Math.max(f,1e-9));let y=o*s[10]<0;d>0&&(!n||y)&&(_=Math.min(c/d,Ns[3]))}return{sectors:a,minRadius:p,maxRadius:_}}function n0({width:s,height:e}){return Array.from({length:Bu},(t,r)=>r/(Bu-1)).flatMap(t=>{let[r,i]=[s*t-.5,e*t-.5];return[[r,-.5],[r,e-.5],[-.5,i],[s-.5,i]]})}function a0(s,e){let t=Math.atan2(-s[6],-s[2]),r=e.map(([l,c])=>{let h=Math.atan2(c,l)-t;return h-2*Math.PI*Math.floor(h/(2*Math.PI)+.5)}),i=2*Math.PI/Tr,n=Math.floor((t+Math.min(...r))/i-.25),a=Math.floor((t+Math.max(...r))/i+.25),o=new Set;for(let l=n;l<=a;++l)o.add((l%Tr+Tr)%Tr);return[...o].sort((l,c)=>l-c)}function o0(s,e){return[1,-1].some(t=>{let[r,i,n]=[t*s[8],t*s[9],t*s[10]];if(n>=-1e-6)return!1;let a=e.fx*r/-n+e.skew*i/-n+e.cx,o=-e.fy*i/-n+e.cy,l=.1*e.width;return-l<=a&&a<=e.width+l&&-l<=o&&o<=e.height+l})}function Wu(s,e){let t=s.findIndex(r=>r>=e);return t<0?s.length:t}function l0(){let s=(e,t,r)=>Array.from({length:r},(i,n)=>e*(t/e)**((n+1)/r));return[0,Ns[0],...i0.flatMap((e,t)=>s(Ns[t],Ns[t+1],e))]}var c0=.01,Zi=class{constructor(e,t,r,i,n){this.gl=e;this.programs=t;this.spec=r;this.formatSwitches=n;this.sums=new Ki(e,t,i),this.grids=new Qi(e,this.sums),this.ripples=this.sums.texture(or,e.REPEAT),this.hemispheres=e.createTexture(),e.bindTexture(e.TEXTURE_2D_ARRAY,this.hemispheres),e.texStorage3D(e.TEXTURE_2D_ARRAY,1,i,Os,Os,2);for(let[a,o]of[[e.TEXTURE_MIN_FILTER,e.LINEAR],[e.TEXTURE_MAG_FILTER,e.LINEAR],[e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE],[e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE]])e.texParameteri(e.TEXTURE_2D_ARRAY,a,o);this.fineMesh=new Ds(e),this.coarseMesh=new Ds(e,Hu)}gl;programs;spec;formatSwitches;sums;grids;ripples;hemispheres;fineMesh;coarseMesh;ripplesKey=[];hemispheresKey=[];switches={};sides=[];isAbove=!1;blockValues=new Float32Array(0);mirror=null;view={sectors:[],minRadius:0,maxRadius:0};prepare({time:e,scale:t,waves:r,ripples:i},n,a,o,l,c){let{grids:h,spec:f}=this;h.set(r,t);let d=me(o),p=d[2]-a,_=h.maxElevation+2*l.near;this.mirror=null,this.isAbove=p>0,this.sides=[...p>-_?[!0]:[],...p<_?[!1]:[]],this.view=Yu(o,l,p,_),this.isDirect&&(this.view.maxRadius=Math.min(this.view.maxRadius,qu(n))),this.switches={...this.formatSwitches};let y=0;r&&this.view.sectors.length&&(y=h.slopeVariance,this.isDirect?h.updateNear(e,d,this.view.maxRadius):h.update(e,d),this.switches.WAVES=h.frames.length,h.hasFoam&&(this.switches.FOAM=1));let w=i?Math.max(f.slope_variance-y,f.short_wave_variance):0;return i&&w>0&&((this.ripplesKey[0]!==i||this.ripplesKey[1]!==e)&&(this.ripplesKey=[i,e],this.sums.draw(i,[0,0],lr/or,e,or,this.ripples.buffers[0])),this.switches.RIPPLES=1),this.updateHemispheres(n,c),this.blockValues=Uu(f,n,h,p,w,o,l,c),this.blockValues}mirrorView(e,t,r,i){if(!this.spec.mirror||!this.view.sectors.length)return null;let n=this.isAbove?i.far:qu(e),a=this.switches.WAVES!==void 0,{pose:o,intrinsics:l}=Lu(r,i,t,n,a),c=Gu(this.blockValues,o);return{pose:o,intrinsics:l,values:c,isMirrored:([,,f])=>this.isAbove?f>t:f<t,switches:{MIRROR:this.isAbove?1:2}}}setMirror(e){this.mirror=e}get isDirect(){return this.sides.length===1&&!this.sides[0]}drawAmong(){this.useTextures(),this.drawSides({DIRECT:1}),this.gl.depthFunc(this.gl.LEQUAL)}draw(e){let{gl:t}=this;this.useTextures(),t.disable(t.DEPTH_TEST),t.disable(t.CULL_FACE),t.bindVertexArray(null),t.useProgram(this.programs.get("air",this.switches,"screen")),t.drawArrays(t.TRIANGLES,0,3),t.enable(t.DEPTH_TEST),t.depthFunc(t.LESS),this.drawSides(e&&!this.spec.mirror?{BODIES_ABOVE:1}:{}),t.depthFunc(t.LEQUAL)}drawSides(e){let{gl:t}=this;t.enable(t.CULL_FACE),t.frontFace(t.CW);for(let r of this.sides){t.cullFace(r?t.BACK:t.FRONT);let i=r?{ABOVE:1}:{};this.mirror&&r===this.isAbove&&(i.MIRROR=1),t.useProgram(this.programs.get("water_surface",{...this.switches,...e,...i})),(this.isDirect?this.coarseMesh:this.fineMesh).draw(this.view)}t.cullFace(t.BACK),t.disable(t.CULL_FACE)}useTextures(){let{gl:e}=this;for(let[t,r,i]of[[Q.wave_grids,e.TEXTURE_2D_ARRAY,this.grids.grids.texture],[Q.wave_grid,e.TEXTURE_2D,this.grids.nearGrid.texture],[Q.ripple_tile,e.TEXTURE_2D,this.ripples.texture],[Q.hemispheres,e.TEXTURE_2D_ARRAY,this.hemispheres],[Q.mirror_image,e.TEXTURE_2D,this.mirror]])e.activeTexture(e.TEXTURE0+t),e.bindTexture(r,i);e.activeTexture(e.TEXTURE0)}updateHemispheres(e,t){let{gl:r}=this,i=[e.transform,t];if(i.every((o,l)=>o===this.hemispheresKey[l]))return;this.hemispheresKey=i;let n=Ru(e,this.spec.sky,t);r.activeTexture(r.TEXTURE0+Q.hemispheres),r.bindTexture(r.TEXTURE_2D_ARRAY,this.hemispheres);let a=Os;r.texSubImage3D(r.TEXTURE_2D_ARRAY,0,0,0,0,a,a,2,r.RGBA,r.FLOAT,n),r.activeTexture(r.TEXTURE0)}};function qu({absorption:s,scattering:e,field:t}){let r=Array.from({length:48},(n,a)=>2*1.25**a),i=r.filter(n=>s.some((a,o)=>{let l=t[0]+t[1]*Math.sqrt(a*n);return Math.exp(-n*(a+l*e[o]))>c0}));return i.length?i.at(-1)*1.25:r[0]}function Xu({worldFromCamera:s,intrinsics:e,water:t,optics:r},i,n,a,o){let{near:l,far:c}=e,{ambient:h,specular:f,suns:d}=i,p=t.light_rate,_=r?.absorption.map((M,S)=>M+r.scattering[S])??t.attenuation,y=t.follows_light===!1?1:p,[w,E]=[t.colour,t.fog_colour].map(M=>M.map(S=>y*S)),x=t.fog>0?E:w;return Float32Array.from([...ht(n),...ht(Ie(o.textureFromWorld,s)),s[8],s[9],s[10],me(s)[2]-t.surface_height,...$s(s,a),o.lift,...d[t.sun].colour.map(M=>p*M),0,p*h,p*f,0,0,...w,0,..._,0,...E,t.fog**2,(c+l)/(c-l),-2*c*l/(c-l),0,0,...x,0])}var Ua=256,en=class{constructor(e,t){this.gl=e;this.models=t;this.values=new Float32Array(Ua/4*Math.max(1,t.instances.length)),this.buffer=e.createBuffer()}gl;models;values;buffer;fill(e,t){this.models.instances.forEach((r,i)=>{let n=Ua/4*i;this.values.set(ht(Ie(e,r.worldFromMesh)),n),t&&this.values.set(ht(Ie(t,r.normals)),n+16)}),this.gl.bindBuffer(this.gl.UNIFORM_BUFFER,this.buffer),this.gl.bufferData(this.gl.UNIFORM_BUFFER,this.values,this.gl.STREAM_DRAW)}drawPiece({instance:e,firstIndex:t,count:r},i){let n=this.gl;e.visual.two_sided?n.disable(n.CULL_FACE):n.enable(n.CULL_FACE),n.frontFace(e.isMirrored!==i?n.CW:n.CCW),n.bindBufferRange(n.UNIFORM_BUFFER,$t.Instance,this.buffer,Ua*e.index,160),n.bindVertexArray(e.vertexArray);let[a,o]=e.hasUint32Indices?[n.UNSIGNED_INT,4]:[n.UNSIGNED_SHORT,2];n.drawElements(n.TRIANGLES,r,a,o*t)}};var f0=320*240,ju=4,tn=class{constructor(e,t,r){this.gl=e;this.head=t;this.models=r;this.isSoftware=ls(e),this.programs=new Pi(e),this.instanceBlocks=new en(e,r),this.shadows=new Ni(e,this.programs,this.instanceBlocks);let{nodes:i}=t.water;this.development=i?Yi.make(e,this.programs,i):null,this.surfacePass=t.surface&&this.development?new Zi(e,this.programs,t.surface,this.development.format,this.development.switches):null,this.focusedLight=t.caustics&&this.development?new $i(e,t.caustics,this.development.format):null,this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(n=>{let a=e.createSampler();return e.samplerParameteri(a,e.TEXTURE_MIN_FILTER,e.LINEAR),e.samplerParameteri(a,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(a,e.TEXTURE_WRAP_S,n),e.samplerParameteri(a,e.TEXTURE_WRAP_T,n),a})}gl;head;models;isSoftware;programs;instanceBlocks;shadows;blocks={};samplers;development;surfacePass;surfaceValues=new Float32Array(0);focusedLight;get lacksFloats(){return!!this.head.water.nodes&&!this.development}draw(e,t,r,i=!1){e.optics&&this.development?this.drawPhysical(e,e.optics,t,r,i):this.drawSurfaces(e,t,r,i,{})}drawPhysical(e,t,r,i,n){let a=this.development,{worldFromCamera:o,water:l}=e,c=this.isSoftware&&!e.isExact,h=this.isSoftware||e.isExact||devicePixelRatio>=2?1:2,{width:f,height:d}=e.intrinsics,p=t.blur&&!(c&&f*d>f0),_=[f,d].map(H=>Math.round(p?t.blur_margin*H:0)),y=bs(Ao(e.intrinsics,..._),h),w=a.plan(y,p),E=e.lamps.slice(0,ju),x=l.surface_height-me(o)[2],M=e.surface?this.surfacePass:null;M&&(this.surfaceValues=M.prepare(e.surface,t,l.surface_height,o,y,l.light_rate),this.fill("Surface",this.surfaceValues));let S=a.prepare(t,o,y,w,x,l.light_rate,M!==null);this.fill("Optics",eu(t,y,E,l.light_rate,w.reach));let k=M?.isDirect,P={PHYSICAL:1,...M?{SKY:1}:{},...a.switches};M&&this.drawMirror(e,t,M,y,P);let F=this.focusLight(e,t),V={...P,...F?.surfaces};if(this.drawSurfaces({...e,intrinsics:y,grey:!1},S,[0,0],!0,V,()=>k&&M.drawAmong()),E.length&&a.drawLampPoints(E.length),M&&!k){let H=({corners:U})=>U.some(X=>X[2]>l.surface_height);a.drawOver(()=>M.draw(this.shownPieces(e).some(H)))}this.gl.disable(this.gl.DEPTH_TEST);let B=wu(this.head.particles,e,y),O=xu(this.head.particles,e),R=a.develop(t,y,w,E.length,e.grey===!0,B,O,F?.shafts??null);a.present(R,r,i,e.intrinsics,_,n)}drawMirror(e,t,r,i,n){let{surface_height:a}=e.water,o=r.mirrorView(t,a,e.worldFromCamera,i);if(!o)return;let{pose:l,intrinsics:c,values:h,isMirrored:f}=o,d={worldFromCamera:l,clip:qt(c,!0),intrinsics:c},p=this.shownPieces(e).filter(({corners:E})=>E.some(f));if(!ks(p,d).length)return;let _={...e,worldFromCamera:l,intrinsics:c,grey:!1},y=e.surface.waves?null:this.focusLight(_,t),w=this.development.mirrorTarget(c);this.fill("Surface",h),this.drawSurfaces(_,w.buffer,[0,0],!0,{...n,...o.switches,...y?.surfaces}),this.fill("Surface",this.surfaceValues),r.setMirror(w.textures[0])}focusLight(e,t){let r=this.focusedLight?.prepare(e,t,Xf(this.models))??null;return r&&this.fill("Caustics",r.values),r}drawSurfaces(e,t,r,i,n,a=()=>{}){let{gl:o}=this,{worldFromCamera:l,intrinsics:c,water:h}=e,f=qt(c,i),d={worldFromCamera:l,clip:f,intrinsics:c},p=this.shownPieces(e),_=ks(p,d),y={COLOUR:0,...n},w=h.fog>0;!n.PHYSICAL&&!w&&(y.NO_FOG=1),!n.PHYSICAL&&w&&h.clip&&!e.isExternal&&(y.FOG_CLIP=1),e.grey&&(y.GREY=1),e.isExternal&&Object.assign(y,n.SKY?{POLISHED:1}:{AIR:1,POLISHED:1}),e.isExternal&&!this.isSoftware&&(y.SOFT=1);let E=n.PHYSICAL?e.optics.sun:xt(this.head.suns[h.sun].direction),x=n.PHYSICAL?h.surface_height:-1/0,M=h.shadows?qf(this.models,p,_,E,d,x):null;M?.casters.length&&(this.shadows.updateSunShadows(M.casters,E,this.models.version),y.SHADOWS=1),M?.hasHulls&&(y.HULLS=1),this.bind(Q.shadow_map,this.shadows.sunMap.texture),this.lightScene(e,p,y),this.fill("Frame",Xu(e,this.head,f,E,this.shadows)),this.instanceBlocks.fill(Ze(l),So(l)),o.bindFramebuffer(o.FRAMEBUFFER,t),o.viewport(r[0],r[1],c.width,c.height),o.enable(o.SCISSOR_TEST),o.scissor(r[0],r[1],c.width,c.height),o.depthMask(!0),o.clear(o.DEPTH_BUFFER_BIT),o.enable(o.DEPTH_TEST),o.depthFunc(o.LEQUAL),o.disable(o.BLEND);for(let S of _.filter(Di))this.drawPiece(S,d,y,i);this.drawBackground(e.grey?{COLOUR:0,GREY:1,...n}:{COLOUR:0,...n}),a(),o.enable(o.BLEND),o.blendFuncSeparate(o.SRC_ALPHA,o.ONE_MINUS_SRC_ALPHA,o.ZERO,o.ONE),o.depthMask(!1);for(let S of _.filter(k=>!Di(k)).reverse()){let k=Math.round(255*S.instance.visual.opacity);k>0&&this.drawPiece(S,d,{...y,OPACITY:k},i)}this.models.maps?.release(),o.depthMask(!0),o.disable(o.BLEND),o.disable(o.SCISSOR_TEST),o.bindVertexArray(null)}shownPieces({isExternal:e}){return this.models.instances.filter(({visual:t,isPresent:r})=>r&&(e||!t.hidden)).flatMap(({pieces:t})=>t)}lightScene(e,t,r){let i=e.lamps.slice(0,ju);i.length&&(r.LAMPS=i.length,this.shadows.updateLampShadows(i,t,this.models.version),this.bind(Q.lamp_maps,this.shadows.lampMaps.texture),this.fill("Lamps",Jf(i,e.worldFromCamera)));let{projector:n}=this.head;if(!n)return;r.PROJECTOR=1;let{width:a,height:o}=this.head.textures[n.pattern],l=this.models.worldFromMount(n),c=Qf(n,a,o);this.shadows.updateProjectorShadows(l,c,t),this.bind(Q.projector_map,this.shadows.projectorMap.texture),this.bind(Q.projector_pattern,this.models.patterns[0]),this.fill("Projector",Zf(n,l,c,e.worldFromCamera))}drawPiece(e,t,r,i){let[{gl:n},{texture:a,repeats:o,visual:l}]=[this,e.instance],c=Yf(e,t)?this.samplers:null,h=this.models.maps.use(l.material,a?{...r,TEXTURED:1}:r,c);if(a){let f=c??this.models.maps.baseSamplers(h);this.bind(Q.base_map,a),n.bindSampler(Q.base_map,f&&f[Number(o)])}n.useProgram(this.programs.get("surface",h)),this.instanceBlocks.drawPiece(e,i)}drawBackground(e){let{gl:t}=this;t.bindSampler(Q.base_map,null),t.disable(t.CULL_FACE),t.bindVertexArray(null),t.useProgram(this.programs.get("background",e)),t.drawArrays(t.TRIANGLES,0,3)}fill(e,t){let{gl:r}=this;this.blocks[e]??=r.createBuffer(),r.bindBuffer(r.UNIFORM_BUFFER,this.blocks[e]),r.bufferData(r.UNIFORM_BUFFER,t,r.STREAM_DRAW),r.bindBufferBase(r.UNIFORM_BUFFER,$t[e],this.blocks[e])}bind(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}};var u0=150;function $u(s){let e=document.createElement("canvas").getContext("webgl2");if(!e)return null;let t=!ls(e);return e.getExtension("WEBGL_lose_context")?.loseContext(),s.getContext("webgl2",{alpha:!1,antialias:t,powerPreference:"high-performance"})}var rn=class s{constructor(e,t,r){this.gl=e;this.models=r;let i=this.head=t.head;this.media=new bi(t),this.surfaces=new Mi(t,i),this.focusingSurfaces=new Ri(t,i),this.renderer=e&&new tn(e,i,r),this.pacing=e&&ls(e)?new Ci(e):null;for(let n of i.cameras){let a=$("figure");a.append($("figcaption",`${n.name} · redrawn, no noise`)),a.style.aspectRatio=`${n.width} / ${n.height}`,z("pictures").append(a),this.frames.push(a)}}gl;models;canvas=z("image");head;overlay=z("overlay");renderer;frames=[];images=[];pacing;media;surfaces;focusingSurfaces;static async make(e,t){return new s(e,t,await ki.load(e,t))}draw(e,t,r,i){let{canvas:n,head:a,models:o}=this,l=this.gl&&ls(this.gl)?1:Math.min(devicePixelRatio,2),[c,h]=[n.clientWidth,n.clientHeight];if(c===0||h===0)return null;for(let O of[n,this.overlay]){let[R,H]=[Math.round(c*l),Math.round(h*l)];(O.width!==R||O.height!==H)&&([O.width,O.height]=[R,H])}o.place(t.poses),a.sand?.forEach((O,R)=>o.setSand(R,e.sand(R,t.time)));let f=r.viewCamera(c,h),d=this.water(e,t,i),p=this.media.mediumAt(t),_=this.lamps(t),{worldFromCamera:y,isExternal:w}=f,E=bs(f.intrinsics,l),x=f.camera?.grey,M=t.drift(),S=e.puffs(t.time),k=this.surfaces.surfaceAt(e.trial,t),P=this.focusingSurfaces.surfaceAt(e.trial,t),F={worldFromCamera:y,intrinsics:E,water:d,optics:p,lamps:_,isExternal:w,grey:x,drift:M,puffs:S,surface:k,focusing:P},V={...F,water:{...d,fog:0},optics:this.media.clearOptics(p),drift:null};this.renderer?.draw(i.clear?V:F,null,[0,0]);let B=this.overlay.getContext("2d");if(B.setTransform(l,0,0,l,0,0),B.clearRect(0,0,c,h),zf(B,y,f.intrinsics,a,o,e,t,i),f.camera&&Ra(B,f.camera,f.intrinsics,0,0,t),r.mode==="map"){let O=z("hud");Bf(B,f.intrinsics,r.height,O.offsetTop+O.offsetHeight)}return this.frames.forEach((O,R)=>O.hidden=a.cameras[R]===f.camera),this.drawPictures(B,{...F,isExternal:!1},t,i,l,h),this.pacing?.begin(),f}get lacksFloats(){return this.renderer?.lacksFloats??!1}skipPauses(){this.pacing?.skipPauses()}isReady(){return this.pacing?.isReady(performance.now())??!0}image(e,t,r,i,n,a={}){let{gl:o,models:l,renderer:c}=this;if(!o||!c)return new Uint8Array;l.place(i.poses);let h=o.createFramebuffer();o.bindFramebuffer(o.FRAMEBUFFER,h);let f=[o.createRenderbuffer(),o.createRenderbuffer()];[o.RGBA8,o.DEPTH_COMPONENT24].forEach((x,M)=>{o.bindRenderbuffer(o.RENDERBUFFER,f[M]),o.renderbufferStorage(o.RENDERBUFFER,x,e.width,e.height);let S=M?o.DEPTH_ATTACHMENT:o.COLOR_ATTACHMENT0;o.framebufferRenderbuffer(o.FRAMEBUFFER,S,o.RENDERBUFFER,f[M])});let{isExternal:d=!1,isClear:p,grey:_}=a,y=this.media.mediumAt(i),w={worldFromCamera:t,intrinsics:e,lamps:this.lamps(i),isExternal:d,isExact:!0,grey:_,drift:p?null:i.drift(),puffs:r.puffs(i.time),surface:this.surfaces.surfaceAt(r.trial,i),focusing:this.focusingSurfaces.surfaceAt(r.trial,i),optics:p?this.media.clearOptics(y):y,water:{...this.water(r,i,n),...a.water,...p?{fog:0}:{}}};c.draw(w,h,[0,0],!0);let E=new Uint8Array(4*e.width*e.height);o.readPixels(0,0,e.width,e.height,o.RGBA,o.UNSIGNED_BYTE,E);for(let x of f)o.deleteRenderbuffer(x);return o.deleteFramebuffer(h),E}pictureWidth(){let e=this.head.cameras.map(({width:t,height:r})=>t/r);return Math.round(u0*Math.max(...e)*Math.min(devicePixelRatio,2))}show(e,t){this.frames[e]&&(this.images[e]?this.images[e].close():this.frames[e].querySelector("figcaption").textContent=this.head.cameras[e].name,this.images[e]=t)}drawPictures(e,t,r,i,n,a){if(z("pictures").hidden=!i.pictures,!i.pictures)return;let o=this.canvas.getBoundingClientRect();this.head.cameras.forEach((l,c)=>{if(this.frames[c].hidden)return;let h=this.frames[c].getBoundingClientRect(),[f,d]=[h.left-o.left+1,h.top-o.top+1],p=Ea(l,h.width-2,h.height-2);if(this.images[c])e.drawImage(this.images[c],f,d,h.width-2,h.height-2);else{let _=this.models.worldFromMount(l),y=[Math.round(f*n),Math.round((a-d-h.height+2)*n)],{grey:w}=l,E={...t,worldFromCamera:_,intrinsics:bs(p,n),grey:w};this.renderer?.draw(E,null,y)}Ra(e,l,p,f,d,r)})}water(e,t,r){let i=e.levels[yr(e,t.time)]?.level.values??{},{fog:n,light_rate:a}=this.head.water;return{...this.head.water,fog:t.signal("fog")??i.fog??n,light_rate:t.signal("light_rate")??i.light??a,sun:r.sun||this.head.water.sun}}lamps(e){return this.head.lamps.map((t,r)=>({lamp:t,index:r,brightness:e.signal(`lamp/${t.name}`)??Number(t.on)})).filter(({brightness:t})=>t>0).map(({lamp:t,index:r,brightness:i})=>({index:r,lamp:{...t,intensity:i*t.intensity},worldFromLamp:this.models.worldFromMount(t)}))}};var us=class{constructor(e,t,r,i={}){this.time=e;for(let[a,o]of Object.entries(i))this.poses.set(a,nt(o));if(!t||!r)return;t.bodies.forEach((a,o)=>this.poses.set(a,nt(r,7*o)));let n=7*t.bodies.length;t.signals.forEach((a,o)=>this.signals.set(a.name,r[n+o]))}time;poses=new Map;signals=new Map;signal(e){let t=this.signals.get(e);return t===void 0||Number.isNaN(t)?void 0:t}drift(){let e=t=>[..."xyz"].map(r=>this.signal(`${t}/${r}`)??0);return{displacement:e("particles"),velocity:e("particle_velocity"),time:this.time}}points(e,t){let r=[];for(let i=0;;++i){if(!this.signals.has(`${e}/${i}/${t[0]}`))return r;let n=t.map(a=>this.signal(`${e}/${i}/${a}`));n.every(a=>a!==void 0)&&r.push(n)}}};var Ga=6,Vs=.2,h0=30,d0=1e4,sn=class{constructor(e){this.pack=e;let t=e.head.trials??[];this.levels=t.flatMap(({levels:r},i)=>r.map(n=>({trial:i,level:n})))}pack;isLive=!1;levels;curves=[];trial=-1;version=0;title="";motion=null;recordedPuffs=null;trailStart=-1/0;get start(){let e=this.levels.filter(({trial:t})=>t===this.trial);return Math.min(this.motion?.head.start??1/0,e[0]?.level.start??0)}get end(){let e=this.levels.filter(({trial:t})=>t===this.trial);return Math.max(this.motion?.end??0,...e.map(({level:t})=>t.end))}async select(e){if(e===this.trial)return;let t=this.pack.head.trials?.[e];if(this.trial=e,this.motion=this.recordedPuffs=null,this.trailStart=-1/0,this.curves=[],!t)return;this.title=t.title,this.curves=t.curves.map(({name:i,unit:n,times:a,values:o,names:l,is_share:c})=>({name:i,unit:n,names:l,isFraction:c,times:Array.from(this.pack.numbers(a),h=>h/d0),values:Array.from(this.pack.numbers(o),h=>Number.isNaN(h)?null:h)})),t.motion&&(this.motion=await ko(this.pack.numbers(t.motion)));let r=this.pack.head.particles?.sediment;r&&this.motion?.births.length&&(this.recordedPuffs=new Ks(r,this.motion.births,i=>this.snapshot(i).drift().velocity))}snapshot(e){let t=this.pack.head.trials?.[this.trial]?.poses;return new us(e,this.motion?.head??null,this.motion?.row(e)??null,t)}speed(e,t){let r=this.motion,i=r?.head.bodies.indexOf(e)??-1;if(!r||i<0)return null;let n=r.head.start+(r.head.n-1)/r.head.rate,a=Math.min(n,Math.max(t,r.head.start+Vs)),o=[a-Vs,a].map(l=>[...r.row(l).slice(7*i,7*i+3)]);return za(o[0],o[1],Vs)}markers(e){let[t,r]=[this.motion,this.motion?.head.markers];if(!t||!r)return[];let i=t.rowIndex(e),n=new Map;for(let a of r.changes){if(a[0]>i)break;a.length>2?n.set(a[1],a):n.delete(a[1])}return[...n.values()].map(([,a,o,l,c])=>{let h=nt(c),f=r.shapes[o].map(d=>d.map(p=>Re(h,p)));return{name:a,at:c.slice(0,3),colour:l,lines:f}})}sand(e,t){let r=this.motion?.rowIndex(t)??-1;return this.motion?.removals.filter(i=>i.heap===e&&i.row<=r)??[]}puffs(e){return this.recordedPuffs?.puffsAt(e)??null}trail(e,t){let r=this.motion,i=r?.head.bodies.indexOf(e)??-1;if(!r||i<0)return[];let{rate:n,start:a,n:o}=r.head,l=Math.min(o-1,Math.floor((t-a)*n)),c=[],h=Math.max(0,Math.ceil((this.trailStart-a)*n));for(let f=h;f<=l;f+=Math.max(1,Math.round(n/Ga))){let d=f*r.columns+7*i;c.push(Array.from(r.rows.subarray(d,d+3)))}return c}clearTrails(e){this.trailStart=e}};function za(s,e,t){let r=Math.hypot(...e.map((i,n)=>i-s[n]))/t;return t>0&&r<h0?r:null}var nn=class{constructor(e){this.head=e;this.title=e.title}head;isLive=!0;start=0;curves=[];levels=[];trial=0;end=0;title;version=0;currentMarkers=[];heights=new Map;currentPuffs=null;row=null;recentRows=[];trails=[];push(e,t){let r=this.trails.at(-1);for(e===this.end&&(this.version+=1),e<this.end&&(this.trails.length=this.recentRows.length=0),(!r||e-r.time>=1/Ga)&&this.trails.push({time:e,row:t}),this.trails.length>2e4&&this.trails.splice(0,1e4),this.recentRows.push({time:e,row:t});this.recentRows.length>2&&this.recentRows[1].time<=e-Vs;)this.recentRows.shift();this.row=t,this.end=e}speed(e){let t=this.head.motion?.bodies.indexOf(e)??-1,[r,i]=[this.recentRows[0],this.recentRows.at(-1)];if(t<0||!r||!i||i.time<=r.time)return null;let n=[r,i].map(({row:a})=>[0,1,2].map(o=>a[7*t+o]));return za(n[0],n[1],i.time-r.time)}sample(e,t,r,i){let n=this.curves.find(a=>a.name===e);n||(n={name:e,unit:t,times:[],values:[]},this.curves.push(n)),n.times.push(r),n.values.push(i)}setLevels(e){this.levels.splice(0,this.levels.length,...e.map(t=>({trial:0,level:t}))),this.version+=1}async select(){}snapshot(){return new us(this.end,this.head.motion??null,this.row)}setMarkers(e){this.currentMarkers=e,this.version+=1}markers(){return this.currentMarkers}setSand(e,t){this.heights.set(e,t),this.version+=1}sand(e){return this.heights.get(e)??[]}setPuffs([e,...t]){let r=Array.from({length:t.length/Qr},(i,n)=>t.slice(Qr*n,Qr*(n+1)));this.currentPuffs={time:e,puffs:r},this.version+=1}puffs(){return this.currentPuffs}trail(e){let t=this.head.motion?.bodies.indexOf(e)??-1;return t<0?[]:this.trails.map(({row:r})=>[0,1,2].map(i=>r[7*t+i]))}clearTrails(){this.trails.length=0}};var m0=.5,an=class{constructor(e){this.pack=e}pack;trial=0;cast(e,t,r,i){let n=1;for(let a of this.pack.head.bodies){let o=Ma(this.pack.head,this.trial,a.name);if(!o.length||i(a))continue;let l=r(a.name);for(let c of o){if(c.hidden||c.opacity<m0)continue;let h=v0(Ie(l,we(c.matrix)));if(!h)continue;let[f,d]=[Re(h,e),Re(h,t)];n=Math.min(n,this.hitMesh(c,f,d,n))}}return n}hitMesh(e,t,r,i){let n=this.pack.head.meshes[e.mesh],a=Me(r,t,-1),o=le(a,a);for(let l of n.pieces){let c=Me([l[2],l[3],l[4]],t,-1),h=o>0?Math.min(i,Math.max(0,le(c,a)/o)):0,f=Me(c,a,-h);if(le(f,f)>l[5]*l[5])continue;let d=this.pack.numbers(n.positions),p=this.pack.numbers(n.triangles);for(let _=l[0];_<l[0]+l[1];_+=3)i=Math.min(i,p0(d,p,_,t,a))}return i}};function p0(s,e,t,r,i){let[n,a,o]=[3*e[t],3*e[t+1],3*e[t+2]],[l,c,h]=[s[n],s[n+1],s[n+2]],[f,d,p]=[s[a]-l,s[a+1]-c,s[a+2]-h],[_,y,w]=[s[o]-l,s[o+1]-c,s[o+2]-h],[E,x,M]=[i[0],i[1],i[2]],[S,k,P]=[x*w-M*y,M*_-E*w,E*y-x*_],F=f*S+d*k+p*P;if(Math.abs(F)<1e-14)return 1/0;let[V,B,O]=[r[0]-l,r[1]-c,r[2]-h],R=(V*S+B*k+O*P)/F;if(R<0||R>1)return 1/0;let[H,U,X]=[B*p-O*d,O*f-V*p,V*d-B*f],W=(E*H+x*U+M*X)/F;if(W<0||R+W>1)return 1/0;let Z=(_*H+y*U+w*X)/F;return Z>=0?Z:1/0}function v0(s){let e=[0,1,2].map(a=>[s[4*a],s[4*a+1],s[4*a+2]]),t=[it(e[1],e[2]),it(e[2],e[0]),it(e[0],e[1])],r=le(e[0],t[0]);if(Math.abs(r)<1e-18)return null;let i=[0,1,2].map(a=>t.map(o=>o[a]/r)),n=i.map(a=>-le(a,[s[3],s[7],s[11]]));return we([...i.flatMap((a,o)=>[...a,n[o]]),0,0,0,1])}function Qu(s){let{player:e,picture:t}=s;Object.assign(window,{uwsim:{page:s,seek:r=>s.seek(r),go:r=>s.go(r),time:()=>s.time,level:()=>yr(e,s.time),curves:()=>Object.fromEntries(e.curves.map(r=>[r.name,pa(r,s.time)])),body:r=>Array.from(t.models.body(r)),markers:()=>e.markers(s.time),sand:r=>Array.from(t.models.heights(r)),puffs:()=>e.puffs(s.time)?.puffs??[],particles:r=>{let{cameras:i,particles:n,water:a}=s.pack.head,o=i.find(h=>h.name===r),l=e.snapshot(s.time);t.models.place(l.poses);let c=t.models.worldFromMount(o);return Array.from(Gi(n,l.drift(),c,o,a.surface_height))},image:(r,i={})=>{let n=s.pack.head.cameras.find(c=>c.name===r),a=e.snapshot(s.time);t.models.place(a.poses);let o=t.models.worldFromMount(n),l={grey:n.grey,water:i};return Ku(t.image(n,o,e,a,s.switches,l))},external:(r,i)=>{let[n]=s.pack.head.cameras,a={isExternal:!0,isClear:i},o=e.snapshot(s.time);return Ku(t.image(n,we(r),e,o,s.switches,a))}}})}function Ku(s){let e="";for(let t=0;t<s.length;t+=8192)e+=String.fromCharCode(...s.subarray(t,t+8192));return btoa(e)}var g0="This browser does not support WebGL 2: the page shows no 3-D view, only the results (levels and curves).",_0="This browser cannot draw into floating-point textures: the page shows the fog of the scene, not its physical water.";async function y0(){let s=matchMedia("(prefers-color-scheme: dark)").matches;document.documentElement.dataset.theme=s?"dark":"light";let e=z("message");e.textContent="Loading…";let t=z("image");bo(t,i=>e.textContent=i);let r=$u(t);try{let i=document.getElementById("pack"),a=i?null:await fc(r===null),o=a?a.pack:await ws(Io(i.textContent??"")),l=await rn.make(r,o),c=a?new nn(o.head):new sn(o),h=new an(o),f=new Si(o,c,l,new Ai(o.head,l.models,h),a,h);f.note=r||a?"":g0,l.lacksFloats&&(f.note=_0),e.textContent=f.note,a?.begin(f,c);let d=Number(new URLSearchParams(location.hash.slice(1)).get("level")??0);a||(await f.select(c.levels[d]?.trial??0),f.seek(c.levels[d]?c.levels[d].level.start:c.start)),Qu(f)}catch(i){if(r?.isContextLost())return;throw e.textContent=i instanceof Error?i.message:String(i),i}}y0();})();
